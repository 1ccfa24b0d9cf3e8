! SPDX-License-Identifier: GPL-3.0-or-later
submodule(wfpsf) wfpsf_moments_procedures
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use wfpsf_c
    use wfpsf_common, only: report
    implicit none

contains

    module procedure moments_measure
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_moments_measure(image%pointer, pointer_of(options), created)
        call replace(self, created, .false.)
        call report(status, stat, errmsg)
    end procedure moments_measure

    module procedure moments_measure_masked
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_moments_measure_masked(image%pointer, pixels_of(missing), &
            pixels_of(variance), pointer_of(options), created)
        call replace(self, created, .false.)
        call report(status, stat, errmsg)
    end procedure moments_measure_masked

    module procedure moments_measure_weighted
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_moments_measure_weighted(image%pointer, x - 1, y - 1, mxx, mxy, myy, created)
        call replace(self, created, .false.)
        call report(status, stat, errmsg)
    end procedure moments_measure_weighted

    module procedure moments_measure_unweighted
        type(c_ptr) :: created
        real(real64) :: about_x, about_y
        integer :: status

        about_x = ieee_value(about_x, ieee_quiet_nan)
        about_y = about_x
        if (present(x)) about_x = x - 1
        if (present(y)) about_y = y - 1
        status = wfpsf_moments_measure_unweighted(image%pointer, about_x, about_y, created)
        call replace(self, created, .false.)
        call report(status, stat, errmsg)
    end procedure moments_measure_unweighted

    module procedure moments_differentiate
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_moments_differentiate(moments%pointer, image%pointer, change%pointer, &
            pixels_of(second), created)
        call replace(self, created, .true.)
        call report(status, stat, errmsg)
    end procedure moments_differentiate

    module procedure moments_influence
        call report(wfpsf_moments_influence(self%pointer, image%pointer, key, influence%pointer), &
            stat, errmsg)
    end procedure moments_influence

    module procedure moments_covariance
        call report(wfpsf_moments_covariance(self%pointer, key_a, key_b, value), stat, errmsg)
    end procedure moments_covariance

    subroutine replace(self, created, are_derivatives)
        class(wfpsf_moments), intent(inout) :: self
        type(c_ptr), intent(in) :: created
        logical, intent(in) :: are_derivatives

        call self%destroy()
        self%pointer = created
        self%are_derivatives = are_derivatives
    end subroutine replace

    ! NULL for an image that is left out.
    function pixels_of(image) result(pointer)
        type(wfpsf_image), intent(in), optional :: image
        type(c_ptr) :: pointer

        pointer = c_null_ptr
        if (present(image)) pointer = image%pointer
    end function pixels_of

    module procedure moments_destroy
        call wfpsf_moments_destroy(self%pointer)
        self%pointer = c_null_ptr
    end procedure moments_destroy

    module procedure moments_status
        status = wfpsf_moments_status(self%pointer)
    end procedure moments_status

    module procedure moments_get
        integer :: status

        status = wfpsf_moments_get(self%pointer, key, value)
        if (status == wfpsf_ok .and. .not. self%are_derivatives .and. &
            (key == wfpsf_moments_centroid_x .or. key == wfpsf_moments_centroid_y)) value = value + 1
        call report(status, stat, errmsg)
    end procedure moments_get

    module procedure moments_finalize
        call self%destroy()
    end procedure moments_finalize

end submodule wfpsf_moments_procedures
