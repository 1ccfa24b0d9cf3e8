! SPDX-License-Identifier: GPL-3.0-or-later
submodule(wfpsf) wfpsf_ipc_procedures
    use, intrinsic :: iso_c_binding, only: c_int64_t
    use wfpsf_c
    use wfpsf_common, only: c_text, report
    implicit none

contains

    subroutine become(self, created, status, stat, errmsg)
        class(wfpsf_ipc_kernel), intent(inout) :: self
        type(c_ptr), intent(in) :: created
        integer, intent(in) :: status
        integer, intent(out), optional :: stat
        character(len=*), intent(inout), optional :: errmsg

        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end subroutine become

    module procedure kernel_create
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_ipc_kernel_create(alpha, alpha_prime, alpha_plus, pointer_of(options), &
            created)
        call become(self, created, status, stat, errmsg)
    end procedure kernel_create

    module procedure kernel_create_taps
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_ipc_kernel_create_taps(size(taps, 1, c_int64_t), &
            size(taps, 2, c_int64_t), taps, pointer_of(options), created)
        call become(self, created, status, stat, errmsg)
    end procedure kernel_create_taps

    module procedure kernel_create_wfc3
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_ipc_kernel_create_wfc3(created)
        call become(self, created, status, stat, errmsg)
    end procedure kernel_create_wfc3

    module procedure kernel_create_default
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_ipc_kernel_create_default(instrument%pointer, created)
        call become(self, created, status, stat, errmsg)
    end procedure kernel_create_default

    module procedure kernel_create_correction
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_ipc_kernel_create_correction(kernel%pointer, created)
        call become(self, created, status, stat, errmsg)
    end procedure kernel_create_correction

    module procedure kernel_create_flipped
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_ipc_kernel_create_flipped(kernel%pointer, created)
        call become(self, created, status, stat, errmsg)
    end procedure kernel_create_flipped

    module procedure kernel_read_fits
        type(c_ptr) :: created
        integer :: status

        if (present(hdu)) then
            status = wfpsf_ipc_kernel_read_fits(c_text(path), c_text(hdu), pointer_of(options), &
                created)
        else
            status = wfpsf_ipc_kernel_read_fits(c_text(path), options=pointer_of(options), &
                out=created)
        end if
        call become(self, created, status, stat, errmsg)
    end procedure kernel_read_fits

    module procedure kernel_create_composed
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_ipc_kernel_create_composed(first%pointer, second%pointer, created)
        call become(self, created, status, stat, errmsg)
    end procedure kernel_create_composed

    module procedure kernel_create_neumann
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_ipc_kernel_create_neumann(kernel%pointer, int(order, c_int64_t), created)
        call become(self, created, status, stat, errmsg)
    end procedure kernel_create_neumann

    module procedure kernel_create_autocorrelation
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_ipc_kernel_create_autocorrelation(kernel%pointer, created)
        call become(self, created, status, stat, errmsg)
    end procedure kernel_create_autocorrelation

    module procedure kernel_destroy
        call wfpsf_ipc_kernel_destroy(self%pointer)
        self%pointer = c_null_ptr
    end procedure kernel_destroy

    module procedure kernel_get_taps
        integer(c_int64_t) :: nx, ny
        integer :: status

        nx = 0
        ny = 0
        status = wfpsf_ipc_kernel_taps(self%pointer, 0_c_int64_t, nx=nx, ny=ny)
        allocate (taps(nx, ny))
        if (status == wfpsf_ok) status = wfpsf_ipc_kernel_taps(self%pointer, nx * ny, taps)
        call report(status, stat, errmsg)
    end procedure kernel_get_taps

    module procedure kernel_get
        call report(wfpsf_ipc_kernel_get(self%pointer, key, value), stat, errmsg)
    end procedure kernel_get

    module procedure kernel_transform
        real(real64) :: real_part, imaginary_part
        integer :: status

        status = wfpsf_ipc_kernel_transform(self%pointer, frequency_x, frequency_y, real_part, &
            imaginary_part)
        if (status == wfpsf_ok) value = cmplx(real_part, imaginary_part, real64)
        call report(status, stat, errmsg)
    end procedure kernel_transform

    module procedure kernel_self_test
        integer(c_int64_t) :: nx, ny
        integer :: status

        nx = 0
        ny = 0
        status = wfpsf_ipc_kernel_taps(self%pointer, 0_c_int64_t, nx=nx, ny=ny)
        allocate (response(nx, ny))
        if (status == wfpsf_ok) &
            status = wfpsf_ipc_kernel_self_test(self%pointer, pointer_of(options), nx * ny, response)
        call report(status, stat, errmsg)
    end procedure kernel_self_test

    module procedure kernel_apply
        call report(wfpsf_ipc_apply(self%pointer, from%pointer, edge, pointer_of(options), &
            to%pointer, not_finite), stat, errmsg)
    end procedure kernel_apply

    module procedure kernel_correct
        call report(wfpsf_ipc_correct(self%pointer, from%pointer, edge, pointer_of(options), &
            to%pointer, residual, noise_amplification, passes, not_finite), stat, errmsg)
    end procedure kernel_correct

    module procedure kernel_covariance
        call report(wfpsf_ipc_covariance(self%pointer, variance%pointer, int(lag_x, c_int64_t), &
            int(lag_y, c_int64_t), edge, pointer_of(options), to%pointer), stat, errmsg)
    end procedure kernel_covariance

    module procedure kernel_finalize
        call self%destroy()
    end procedure kernel_finalize

end submodule wfpsf_ipc_procedures
