! SPDX-License-Identifier: GPL-3.0-or-later
submodule(wfpsf) wfpsf_options_procedures
    use, intrinsic :: iso_c_binding, only: c_funloc, c_funptr, c_int64_t, c_null_funptr
    use wfpsf_c
    use wfpsf_common, only: report
    implicit none

contains

    ! From the Fortran to the C value of an option: positions count from 1 here, from 0 there.
    pure function origin(key)
        integer, intent(in) :: key
        real(real64) :: origin

        origin = merge(1.0_real64, 0.0_real64, &
            key == wfpsf_option_moments_guess_x .or. key == wfpsf_option_moments_guess_y)
    end function origin

    module procedure options_create
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_options_create(created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure options_create

    module procedure options_destroy
        call wfpsf_options_destroy(self%pointer)
        self%pointer = c_null_ptr
    end procedure options_destroy

    module procedure options_set_real
        call report(wfpsf_options_set_real(self%pointer, key, value - origin(key)), stat, errmsg)
    end procedure options_set_real

    module procedure options_set_integer
        call report(wfpsf_options_set_integer(self%pointer, key, int(value, c_int64_t)), stat, &
            errmsg)
    end procedure options_set_integer

    module procedure options_get
        integer :: status

        status = wfpsf_options_get(self%pointer, key, value)
        if (status == wfpsf_ok) value = value + origin(key)
        call report(status, stat, errmsg)
    end procedure options_get

    module procedure options_reset
        call report(wfpsf_options_reset(self%pointer, key), stat, errmsg)
    end procedure options_reset

    module procedure options_set_zernikes
        call report(wfpsf_options_set_zernikes(self%pointer, size(coefficients, kind=c_int64_t), &
            coefficients), stat, errmsg)
    end procedure options_set_zernikes

    module procedure options_set_opd
        call report(wfpsf_options_set_opd(self%pointer, map%pointer, scale_m, axis_x - 1, &
            axis_y - 1), stat, errmsg)
    end procedure options_set_opd

    module procedure options_set_scene_store
        type(c_ptr) :: shared

        shared = c_null_ptr
        if (present(store)) shared = store%pointer
        call report(wfpsf_options_set_scene_store(self%pointer, shared), stat, errmsg)
    end procedure options_set_scene_store

    module procedure options_set_progress
        type(c_funptr) :: call_back
        type(c_ptr) :: passed

        call_back = c_null_funptr
        if (present(progress)) call_back = c_funloc(progress)
        passed = c_null_ptr
        if (present(user)) passed = user
        call report(wfpsf_options_set_progress(self%pointer, call_back, passed), stat, errmsg)
    end procedure options_set_progress

    module procedure options_finalize
        call self%destroy()
    end procedure options_finalize

end submodule wfpsf_options_procedures
