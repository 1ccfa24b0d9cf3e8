! SPDX-License-Identifier: GPL-3.0-or-later
! What all objects have in common, and the version of the library.
submodule(wfpsf) wfpsf_handle
    use, intrinsic :: iso_c_binding, only: c_associated
    use wfpsf_c
    use wfpsf_common, only: f_text, report
    implicit none

contains

    module procedure is_empty
        is_empty = .not. c_associated(self%pointer)
    end procedure is_empty

    module procedure refuse_assignment
        if (same_type_as(self, other)) error stop "wfpsf: an object cannot be assigned to another"
        error stop "wfpsf: objects of different types"
    end procedure refuse_assignment

    module procedure pointer_of
        pointer = c_null_ptr
        if (present(options)) pointer = options%pointer
    end procedure pointer_of

    module procedure wfpsf_check_version
        call report(wfpsf_abi_check(wfpsf_headers_abi_number), stat, errmsg)
    end procedure wfpsf_check_version

    module procedure wfpsf_library_version
        version = f_text(wfpsf_version())
    end procedure wfpsf_library_version

end submodule wfpsf_handle
