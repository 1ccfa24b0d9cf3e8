! SPDX-License-Identifier: GPL-3.0-or-later
submodule(wfpsf) wfpsf_design_procedures
    use, intrinsic :: iso_c_binding, only: c_int64_t
    use wfpsf_c
    use wfpsf_common, only: c_text, report
    implicit none

contains

    module procedure design_create
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_design_create(created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure design_create

    module procedure design_destroy
        call wfpsf_design_destroy(self%pointer)
        self%pointer = c_null_ptr
    end procedure design_destroy

    module procedure design_set_telescope
        call report(wfpsf_design_set_telescope(self%pointer, diameter_m, obscuration, &
            reference_wavelength_nm), stat, errmsg)
    end procedure design_set_telescope

    module procedure design_add_strut
        real(real64) :: offset

        offset = 0
        if (present(offset_m)) offset = offset_m
        call report(wfpsf_design_add_strut(self%pointer, azimuth_deg, width_m, offset), stat, errmsg)
    end procedure design_add_strut

    module procedure design_set_detector
        call report(wfpsf_design_set_detector(self%pointer, sca_count, pixel_scale_arcsec, &
            int(n_pix_x, c_int64_t), int(n_pix_y, c_int64_t)), stat, errmsg)
    end procedure design_set_detector

    module procedure design_set_zernikes
        call report(wfpsf_design_set_zernikes(self%pointer, sca, &
            size(coefficients, kind=c_int64_t), coefficients), stat, errmsg)
    end procedure design_set_zernikes

    module procedure design_set_field
        integer(c_int64_t) :: n

        ! A negative count makes the library refuse anything but five points.
        n = size(coefficients, 1, kind=c_int64_t)
        if (any([size(x), size(y), size(coefficients, 2)] /= 5)) n = -1
        call report(wfpsf_design_set_field(self%pointer, sca, x - 1, y - 1, n, &
            reshape(coefficients, [size(coefficients)])), stat, errmsg)
    end procedure design_set_field

    module procedure design_add_band
        call report(wfpsf_design_add_band(self%pointer, c_text(name), first_nm, step_nm, &
            size(throughput, kind=c_int64_t), throughput), stat, errmsg)
    end procedure design_add_band

    module procedure design_finalize
        call self%destroy()
    end procedure design_finalize

    module procedure instrument_create_from_design
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_instrument_create_from_design(design%pointer, created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure instrument_create_from_design

end submodule wfpsf_design_procedures
