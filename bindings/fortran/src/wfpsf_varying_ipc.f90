! SPDX-License-Identifier: GPL-3.0-or-later
submodule(wfpsf) wfpsf_varying_ipc_procedures
    use, intrinsic :: iso_c_binding, only: c_int64_t
    use wfpsf_c
    use wfpsf_common, only: report
    implicit none

contains

    module procedure varying_ipc_create_maps
        type(c_ptr) :: created, prime, plus
        integer :: status

        prime = c_null_ptr
        if (present(alpha_prime)) prime = alpha_prime%pointer
        plus = c_null_ptr
        if (present(alpha_plus)) plus = alpha_plus%pointer
        status = wfpsf_varying_ipc_create_maps(alpha%pointer, prime, plus, pointer_of(options), &
            created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure varying_ipc_create_maps

    module procedure varying_ipc_create_polynomials
        type(c_ptr) :: created
        integer :: status, checked

        ! A degree of -1 makes the library refuse arrays of other sizes.
        checked = degree
        if (size(alpha) /= coefficients_of(degree)) checked = -1
        if (present(alpha_prime)) then
            if (size(alpha_prime) /= size(alpha)) checked = -1
        end if
        if (present(alpha_plus)) then
            if (size(alpha_plus) /= size(alpha)) checked = -1
        end if
        status = wfpsf_varying_ipc_create_polynomials(int(nx, c_int64_t), int(ny, c_int64_t), &
            int(checked, c_int64_t), alpha, alpha_prime, alpha_plus, pointer_of(options), created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure varying_ipc_create_polynomials

    pure integer function coefficients_of(degree)
        integer, intent(in) :: degree

        coefficients_of = (degree + 1) * (degree + 2) / 2
    end function coefficients_of

    module procedure varying_ipc_create_regions
        type(c_ptr) :: created
        type(c_ptr) :: pointers(size(kernels))
        type(wfpsf_image) :: from_zero
        real(real64), allocatable :: labels(:, :)
        real(real64), allocatable, target :: shifted(:, :)
        integer :: status, k

        pointers = [(kernels(k)%pointer, k = 1, size(kernels))]
        call regions%get_pixels(labels, stat, errmsg)
        if (present(stat)) then
            if (stat < 0) return
        end if
        shifted = labels - 1
        call from_zero%wrap(shifted, 1)
        status = wfpsf_varying_ipc_create_regions(from_zero%pointer, &
            size(pointers, kind=c_int64_t), pointers, created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure varying_ipc_create_regions

    module procedure varying_ipc_destroy
        call wfpsf_varying_ipc_destroy(self%pointer)
        self%pointer = c_null_ptr
    end procedure varying_ipc_destroy

    module procedure varying_ipc_get_kernel
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_varying_ipc_kernel(self%pointer, int(x - 1, c_int64_t), &
            int(y - 1, c_int64_t), created)
        call kernel%destroy()
        kernel%pointer = created
        call report(status, stat, errmsg)
    end procedure varying_ipc_get_kernel

    module procedure varying_ipc_get_margin
        integer(c_int64_t) :: at_x, at_y
        integer :: status

        at_x = -1
        at_y = -1
        status = wfpsf_varying_ipc_margin(self%pointer, margin, at_x, at_y)
        if (present(x)) x = int(at_x) + 1
        if (present(y)) y = int(at_y) + 1
        call report(status, stat, errmsg)
    end procedure varying_ipc_get_margin

    module procedure varying_ipc_apply
        call report(wfpsf_varying_ipc_apply(self%pointer, from%pointer, edge, pointer_of(options), &
            to%pointer, not_finite), stat, errmsg)
    end procedure varying_ipc_apply

    module procedure varying_ipc_correct
        call report(wfpsf_varying_ipc_correct(self%pointer, from%pointer, edge, pointer_of(options), &
            to%pointer, residual, noise_amplification, passes, not_finite), stat, errmsg)
    end procedure varying_ipc_correct

    module procedure varying_ipc_covariance
        call report(wfpsf_varying_ipc_covariance(self%pointer, variance%pointer, &
            int(lag_x, c_int64_t), int(lag_y, c_int64_t), edge, pointer_of(options), to%pointer), &
            stat, errmsg)
    end procedure varying_ipc_covariance

    module procedure varying_ipc_get_autocorrelation
        type(c_ptr) :: given
        integer(c_int64_t) :: nx, ny
        integer :: status

        given = c_null_ptr
        if (present(variance)) given = variance%pointer
        nx = 0
        ny = 0
        status = ask(0_c_int64_t)
        allocate (covariances(nx, ny))
        if (status == wfpsf_ok) status = ask(nx * ny, covariances)
        call report(status, stat, errmsg)

    contains

        integer function ask(capacity, numbers)
            integer(c_int64_t), intent(in) :: capacity
            real(real64), intent(inout), optional :: numbers(:, :)

            ask = wfpsf_varying_ipc_autocorrelation(self%pointer, given, int(x - 1, c_int64_t), &
                int(y - 1, c_int64_t), edge, pointer_of(options), capacity, numbers, nx, ny)
        end function ask
    end procedure varying_ipc_get_autocorrelation

    module procedure varying_ipc_finalize
        call self%destroy()
    end procedure varying_ipc_finalize

end submodule wfpsf_varying_ipc_procedures
