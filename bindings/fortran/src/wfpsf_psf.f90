! SPDX-License-Identifier: GPL-3.0-or-later
submodule(wfpsf) wfpsf_psf_procedures
    use, intrinsic :: iso_c_binding, only: c_int64_t
    use wfpsf_c
    use wfpsf_common, only: c_text, report
    implicit none

contains

    module procedure psf_create
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_psf_create(instrument%pointer, sca, wavelength_nm, pointer_of(options), &
            created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure psf_create

    module procedure psf_create_from_mask
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_psf_create_from_mask(instrument%pointer, mask%pointer, mask_scale_m, &
            axis_x - 1, axis_y - 1, sca, wavelength_nm, pointer_of(options), created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure psf_create_from_mask

    module procedure psf_create_in_band
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_psf_create_in_band(instrument%pointer, c_text(band), sca, x - 1, y - 1, &
            wavelength_nm, pointer_of(options), created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure psf_create_in_band

    module procedure psf_create_chromatic
        type(c_ptr) :: created(1)
        integer :: status

        created = c_null_ptr
        status = wfpsf_psf_create_chromatic(instrument%pointer, c_text(band), sca, x - 1, y - 1, &
            1_c_int64_t, [sed%pointer], pointer_of(options), created)
        call self%destroy()
        self%pointer = created(1)
        call report(status, stat, errmsg)
    end procedure psf_create_chromatic

    module procedure wfpsf_psf_create_chromatic_each
        type(c_ptr) :: created(size(psfs))
        integer(c_int64_t) :: n
        integer :: i, status

        ! A negative count makes the library refuse arrays of different sizes.
        n = size(seds, kind=c_int64_t)
        if (size(psfs, kind=c_int64_t) /= n) n = -1
        created = c_null_ptr
        status = wfpsf_psf_create_chromatic(instrument%pointer, c_text(band), sca, x - 1, y - 1, &
            n, [(seds(i)%pointer, i = 1, size(seds))], pointer_of(options), created)
        do i = 1, size(psfs)
            call psfs(i)%destroy()
            psfs(i)%pointer = created(i)
        end do
        call report(status, stat, errmsg)
    end procedure wfpsf_psf_create_chromatic_each

    module procedure psf_destroy
        call wfpsf_psf_destroy(self%pointer)
        self%pointer = c_null_ptr
    end procedure psf_destroy

    module procedure psf_draw
        call report(wfpsf_psf_draw(self%pointer, x - 1, y - 1, flux, pointer_of(options), &
            image%pointer), stat, errmsg)
    end procedure psf_draw

    module procedure psf_add_bright_star
        call report(wfpsf_psf_add_bright_star(self%pointer, x - 1, y - 1, flux, &
            pointer_of(options), image%pointer), stat, errmsg)
    end procedure psf_add_bright_star

    module procedure psf_draw_memory
        call report(wfpsf_psf_draw_memory(self%pointer, x - 1, y - 1, image%pointer, least, &
            most), stat, errmsg)
    end procedure psf_draw_memory

    module procedure psf_add_stars
        integer(c_int64_t) :: n

        ! A negative count makes the library refuse arrays of different sizes.
        n = size(x, kind=c_int64_t)
        if (size(y, kind=c_int64_t) /= n .or. size(flux, kind=c_int64_t) /= n) n = -1
        call report(wfpsf_psf_add_stars(self%pointer, n, x - 1, y - 1, flux, pointer_of(options), &
            image%pointer), stat, errmsg)
    end procedure psf_add_stars

    module procedure psf_convolve
        call report(wfpsf_psf_convolve(self%pointer, galaxy%pointer, x - 1, y - 1, flux, &
            pointer_of(options), image%pointer), stat, errmsg)
    end procedure psf_convolve

    module procedure psf_get
        call report(wfpsf_psf_get(self%pointer, key, value), stat, errmsg)
    end procedure psf_get

    module procedure psf_finalize
        call self%destroy()
    end procedure psf_finalize

end submodule wfpsf_psf_procedures
