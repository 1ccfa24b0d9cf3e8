! SPDX-License-Identifier: GPL-3.0-or-later
submodule(wfpsf) wfpsf_study_procedures
    use wfpsf_c
    use wfpsf_common, only: c_text, f_text, report
    implicit none

contains

    module procedure study_create
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_study_create(instrument%pointer, sca, pointer_of(options), created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure study_create

    module procedure study_destroy
        call wfpsf_study_destroy(self%pointer)
        self%pointer = c_null_ptr
    end procedure study_destroy

    module procedure study_size
        call report(wfpsf_study_size(self%pointer, table, rows, columns), stat, errmsg)
    end procedure study_size

    module procedure study_column
        name = f_text(wfpsf_study_column(self%pointer, table, column - 1))
    end procedure study_column

    module procedure study_value
        call report(wfpsf_study_value(self%pointer, table, row - 1, column - 1, value), stat, &
            errmsg)
    end procedure study_value

    module procedure study_text
        words = f_text(wfpsf_study_text(self%pointer, table, row - 1, column - 1))
    end procedure study_text

    module procedure study_write_csv
        call report(wfpsf_study_write_csv(self%pointer, c_text(folder)), stat, errmsg)
    end procedure study_write_csv

    module procedure study_finalize
        call self%destroy()
    end procedure study_finalize

end submodule wfpsf_study_procedures
