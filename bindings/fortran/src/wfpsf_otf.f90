! SPDX-License-Identifier: GPL-3.0-or-later
submodule(wfpsf) wfpsf_otf_procedures
    use, intrinsic :: iso_c_binding, only: c_int64_t
    use wfpsf_c
    use wfpsf_common, only: report
    implicit none

contains

    module procedure otf_create
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_otf_create(psf%pointer, pointer_of(options), created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure otf_create

    module procedure otf_destroy
        call wfpsf_otf_destroy(self%pointer)
        self%pointer = c_null_ptr
    end procedure otf_destroy

    module procedure otf_values
        integer(c_int64_t) :: n

        ! A negative count makes the library refuse arrays of different sizes.
        n = size(kx, kind=c_int64_t)
        if (any([size(ky, kind=c_int64_t), size(re, kind=c_int64_t), &
            size(im, kind=c_int64_t)] /= n)) n = -1
        call report(wfpsf_otf_values(self%pointer, response, n, kx, ky, re, im), stat, errmsg)
    end procedure otf_values

    module procedure otf_grid
        call report(wfpsf_otf_grid(self%pointer, response, order, step, re%pointer, im%pointer), &
            stat, errmsg)
    end procedure otf_grid

    module procedure otf_get
        call report(wfpsf_otf_get(self%pointer, key, value), stat, errmsg)
    end procedure otf_get

    module procedure otf_finalize
        call self%destroy()
    end procedure otf_finalize

end submodule wfpsf_otf_procedures
