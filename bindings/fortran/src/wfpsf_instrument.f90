! SPDX-License-Identifier: GPL-3.0-or-later
submodule(wfpsf) wfpsf_instrument_procedures
    use, intrinsic :: iso_c_binding, only: c_int64_t
    use wfpsf_c
    use wfpsf_common, only: c_text, f_text, report
    implicit none

contains

    module procedure instrument_create
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_instrument_create(c_text(name), created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure instrument_create

    module procedure instrument_destroy
        call wfpsf_instrument_destroy(self%pointer)
        self%pointer = c_null_ptr
    end procedure instrument_destroy

    module procedure instrument_constant
        type(c_ptr) :: c_unit
        integer :: status

        c_unit = c_null_ptr
        status = wfpsf_instrument_constant(self%pointer, c_text(name), value, c_unit)
        if (present(unit)) unit = f_text(c_unit)
        call report(status, stat, errmsg)
    end procedure instrument_constant

    module procedure instrument_constant_name
        name = f_text(wfpsf_instrument_constant_name(self%pointer, index - 1_c_int64_t))
    end procedure instrument_constant_name

    module procedure instrument_band
        call report(wfpsf_instrument_band(self%pointer, c_text(band), rule, blue_nm, red_nm, &
            effective_nm), stat, errmsg)
    end procedure instrument_band

    module procedure instrument_band_name
        name = f_text(wfpsf_instrument_band_name(self%pointer, index - 1_c_int64_t))
    end procedure instrument_band_name

    module procedure instrument_throughput
        integer(c_int64_t) :: n

        ! A negative count makes the library refuse arrays of two sizes.
        n = size(wavelength_nm, kind=c_int64_t)
        if (size(throughput, kind=c_int64_t) /= n) n = -1
        call report(wfpsf_instrument_throughput(self%pointer, c_text(band), n, wavelength_nm, &
            throughput), stat, errmsg)
    end procedure instrument_throughput

    module procedure instrument_zernikes
        real(real64) :: none(1)
        integer(c_int64_t) :: n
        integer :: status

        n = 0
        status = wfpsf_instrument_zernikes(self%pointer, sca, 0_c_int64_t, none, n)
        allocate (coefficients(n))
        if (status == wfpsf_ok) then
            status = wfpsf_instrument_zernikes(self%pointer, sca, n, coefficients, n)
        end if
        call report(status, stat, errmsg)
    end procedure instrument_zernikes

    module procedure instrument_pupil
        integer :: status

        status = wfpsf_instrument_pupil(self%pointer, c_text(band), sca, pointer_of(options), &
            image%pointer, scale_m, axis_x, axis_y)
        if (status == wfpsf_ok) then
            axis_x = axis_x + 1
            axis_y = axis_y + 1
        end if
        call report(status, stat, errmsg)
    end procedure instrument_pupil

    module procedure instrument_finalize
        call self%destroy()
    end procedure instrument_finalize

end submodule wfpsf_instrument_procedures
