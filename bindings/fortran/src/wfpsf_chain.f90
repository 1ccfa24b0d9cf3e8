! SPDX-License-Identifier: GPL-3.0-or-later
submodule(wfpsf) wfpsf_chain_procedures
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use, intrinsic :: iso_c_binding, only: c_int64_t
    use wfpsf_c
    use wfpsf_common, only: c_text, report
    implicit none

contains

    module procedure chain_create
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_chain_create(created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure chain_create

    module procedure chain_create_default
        type(c_ptr) :: created
        real(real64) :: time
        integer :: status

        time = ieee_value(time, ieee_quiet_nan)
        if (present(exposure_time)) time = exposure_time
        status = wfpsf_chain_create_default(instrument%pointer, time, created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure chain_create_default

    module procedure chain_destroy
        call wfpsf_chain_destroy(self%pointer)
        self%pointer = c_null_ptr
    end procedure chain_destroy

    module procedure chain_add
        call report(wfpsf_chain_add(self%pointer, step, size(parameters, kind=c_int64_t), &
            parameters), stat, errmsg)
    end procedure chain_add

    module procedure chain_add_ipc
        call report(wfpsf_chain_add_ipc(self%pointer, kernel%pointer, edge), stat, errmsg)
    end procedure chain_add_ipc

    module procedure chain_add_varying_ipc
        call report(wfpsf_chain_add_varying_ipc(self%pointer, varying%pointer, form, edge), stat, &
            errmsg)
    end procedure chain_add_varying_ipc

    module procedure chain_add_map
        call report(wfpsf_chain_add_map(self%pointer, step, size(parameters, kind=c_int64_t), &
            parameters, map%pointer), stat, errmsg)
    end procedure chain_add_map

    module procedure chain_get_step
        integer(c_int64_t) :: count
        integer :: status

        count = 0
        step = 0
        status = wfpsf_chain_step(self%pointer, int(index - 1, c_int64_t), 0_c_int64_t, &
            count=count, step=step)
        allocate (parameters(count))
        if (status == wfpsf_ok) status = wfpsf_chain_step(self%pointer, &
            int(index - 1, c_int64_t), count, parameters, step=step)
        call report(status, stat, errmsg)
    end procedure chain_get_step

    module procedure chain_apply
        type(c_ptr), allocatable :: pointers(:)
        integer :: k

        allocate (pointers(0))
        if (present(previous)) pointers = [(previous(k)%pointer, k = 1, size(previous))]
        call report(wfpsf_chain_apply(self%pointer, image%pointer, &
            size(pointers, kind=c_int64_t), pointers, pointer_of(options), not_finite, &
            saturated), stat, errmsg)
    end procedure chain_apply

    module procedure chain_finalize
        call self%destroy()
    end procedure chain_finalize

    module procedure wfpsf_add_noise
        type(c_ptr) :: through

        through = c_null_ptr
        if (present(kernel)) through = kernel%pointer
        call report(wfpsf_noise_add(image%pointer, rms, through, pointer_of(options)), stat, errmsg)
    end procedure wfpsf_add_noise

    module procedure instrument_get_sky_level
        call report(wfpsf_sky_level(self%pointer, c_text(band), longitude, latitude, level), stat, &
            errmsg)
    end procedure instrument_get_sky_level

    module procedure instrument_get_sky_background
        call report(wfpsf_sky_background(self%pointer, c_text(band), longitude, latitude, &
            exposure_time, pixel_area, electrons), stat, errmsg)
    end procedure instrument_get_sky_background

end submodule wfpsf_chain_procedures
