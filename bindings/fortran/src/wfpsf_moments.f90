! SPDX-License-Identifier: GPL-3.0-or-later
submodule(wfpsf) wfpsf_moments_procedures
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use wfpsf_c
    use wfpsf_common, only: report
    implicit none

contains

    module procedure moments_measure
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_moments_measure(image%pointer, pointer_of(options), created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure moments_measure

    module procedure moments_measure_unweighted
        type(c_ptr) :: created
        real(real64) :: about_x, about_y
        integer :: status

        about_x = ieee_value(about_x, ieee_quiet_nan)
        about_y = about_x
        if (present(x)) about_x = x - 1
        if (present(y)) about_y = y - 1
        status = wfpsf_moments_measure_unweighted(image%pointer, about_x, about_y, created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure moments_measure_unweighted

    module procedure moments_destroy
        call wfpsf_moments_destroy(self%pointer)
        self%pointer = c_null_ptr
    end procedure moments_destroy

    module procedure moments_status
        status = wfpsf_moments_status(self%pointer)
    end procedure moments_status

    module procedure moments_get
        integer :: status

        status = wfpsf_moments_get(self%pointer, key, value)
        if (status == wfpsf_ok .and. (key == wfpsf_moments_centroid_x &
            .or. key == wfpsf_moments_centroid_y)) value = value + 1
        call report(status, stat, errmsg)
    end procedure moments_get

    module procedure moments_finalize
        call self%destroy()
    end procedure moments_finalize

end submodule wfpsf_moments_procedures
