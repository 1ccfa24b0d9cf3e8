! SPDX-License-Identifier: GPL-3.0-or-later
submodule(wfpsf) wfpsf_varying_psf_procedures
    use, intrinsic :: iso_c_binding, only: c_int64_t
    use wfpsf_c
    use wfpsf_common, only: c_text, report
    implicit none

contains

    module procedure varying_psf_create
        type(c_ptr) :: created, source
        real(real64) :: wavelength
        integer :: status

        wavelength = 0
        if (present(wavelength_nm)) wavelength = wavelength_nm
        source = c_null_ptr
        if (present(sed)) source = sed%pointer
        status = wfpsf_varying_psf_create(instrument%pointer, c_text(band), sca, wavelength, &
            source, pointer_of(options), created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure varying_psf_create

    module procedure varying_psf_destroy
        call wfpsf_varying_psf_destroy(self%pointer)
        self%pointer = c_null_ptr
    end procedure varying_psf_destroy

    module procedure varying_psf_at
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_varying_psf_at(self%pointer, x - 1, y - 1, created)
        call psf%destroy()
        psf%pointer = created
        call report(status, stat, errmsg)
    end procedure varying_psf_at

    module procedure varying_psf_add_stars
        integer(c_int64_t) :: n

        ! A negative count makes the library refuse arrays of different sizes.
        n = size(x, kind=c_int64_t)
        if (size(y, kind=c_int64_t) /= n .or. size(flux, kind=c_int64_t) /= n) n = -1
        call report(wfpsf_varying_psf_add_stars(self%pointer, x0 - 1, y0 - 1, n, x - 1, y - 1, &
            flux, pointer_of(options), image%pointer), stat, errmsg)
    end procedure varying_psf_add_stars

    module procedure varying_psf_get
        call report(wfpsf_varying_psf_get(self%pointer, key, value), stat, errmsg)
    end procedure varying_psf_get

    module procedure varying_psf_finalize
        call self%destroy()
    end procedure varying_psf_finalize

end submodule wfpsf_varying_psf_procedures
