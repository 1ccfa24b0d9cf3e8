! SPDX-License-Identifier: GPL-3.0-or-later
submodule(wfpsf) wfpsf_image_procedures
    use, intrinsic :: iso_c_binding, only: c_int64_t, c_intptr_t, c_loc
    use wfpsf_c
    use wfpsf_common, only: c_text, report
    implicit none

contains

    module procedure image_create
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_image_create(pixel_type, int(nx, c_int64_t), int(ny, c_int64_t), &
            int(oversampling, c_int64_t), created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure image_create

    module procedure image_wrap_real32
        type(c_ptr) :: first, right, above

        first = c_null_ptr
        if (size(array) > 0) first = c_loc(array(1, 1))
        right = first
        above = first
        if (size(array, 1) > 1 .and. size(array) > 0) right = c_loc(array(2, 1))
        if (size(array, 2) > 1 .and. size(array) > 0) above = c_loc(array(1, 2))
        call wrap(self, wfpsf_float32, first, right, above, shape(array), oversampling, stat, &
            errmsg)
    end procedure image_wrap_real32

    module procedure image_wrap_real64
        type(c_ptr) :: first, right, above

        first = c_null_ptr
        if (size(array) > 0) first = c_loc(array(1, 1))
        right = first
        above = first
        if (size(array, 1) > 1 .and. size(array) > 0) right = c_loc(array(2, 1))
        if (size(array, 2) > 1 .and. size(array) > 0) above = c_loc(array(1, 2))
        call wrap(self, wfpsf_float64, first, right, above, shape(array), oversampling, stat, &
            errmsg)
    end procedure image_wrap_real64

    ! Strides from the addresses of the first pixel and its neighbours, if it has any.
    subroutine wrap(self, pixel_type, first, right, above, n, oversampling, stat, errmsg)
        class(wfpsf_image), intent(inout) :: self
        integer(c_int32_t), intent(in) :: pixel_type
        type(c_ptr), intent(in) :: first, right, above
        integer, intent(in) :: n(2), oversampling
        integer, intent(out), optional :: stat
        character(len=*), intent(inout), optional :: errmsg
        type(c_ptr) :: created
        integer(c_int64_t) :: stride(2)
        integer :: status

        stride = [distance(first, right), distance(first, above)] / (pixel_type / 8)
        if (n(1) == 1) stride(1) = 1
        if (n(2) == 1) stride(2) = n(1) * stride(1)
        status = wfpsf_image_wrap(pixel_type, first, int(n(1), c_int64_t), int(n(2), c_int64_t), &
            stride(1), stride(2), int(oversampling, c_int64_t), created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end subroutine wrap

    pure function distance(from, to) result(bytes)
        type(c_ptr), intent(in) :: from, to
        integer(c_int64_t) :: bytes

        bytes = transfer(to, 0_c_intptr_t) - transfer(from, 0_c_intptr_t)
    end function distance

    module procedure image_read_fits
        type(c_ptr) :: created
        integer :: status, type_wanted

        type_wanted = 0
        if (present(pixel_type)) type_wanted = pixel_type
        if (present(hdu)) then
            status = wfpsf_image_read_fits(c_text(path), c_text(hdu), type_wanted, created)
        else
            status = wfpsf_image_read_fits(c_text(path), pixel_type=type_wanted, out=created)
        end if
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure image_read_fits

    module procedure image_write_fits
        call report(wfpsf_image_write_fits(self%pointer, c_text(path), pointer_of(options)), stat, &
            errmsg)
    end procedure image_write_fits

    module procedure image_destroy
        call wfpsf_image_destroy(self%pointer)
        self%pointer = c_null_ptr
    end procedure image_destroy

    module procedure image_get_shape
        integer(c_int64_t) :: columns, rows
        integer(c_int32_t) :: stored
        integer :: status

        status = wfpsf_image_shape(self%pointer, stored, columns, rows)
        if (status == wfpsf_ok) then
            if (present(pixel_type)) pixel_type = stored
            if (present(nx)) nx = int(columns)
            if (present(ny)) ny = int(rows)
        end if
        call report(status, stat, errmsg)
    end procedure image_get_shape

    module procedure image_get_record
        integer(c_int64_t) :: samples
        integer :: status

        status = wfpsf_image_record(self%pointer, samples, pixel_scale_arcsec, applied)
        if (status == wfpsf_ok .and. present(oversampling)) oversampling = int(samples)
        call report(status, stat, errmsg)
    end procedure image_get_record

    module procedure image_set_record
        call report(wfpsf_image_set_record(self%pointer, int(oversampling, c_int64_t), &
            pixel_scale_arcsec, applied), stat, errmsg)
    end procedure image_set_record

    module procedure image_copy_from
        call report(wfpsf_image_copy(other%pointer, self%pointer), stat, errmsg)
    end procedure image_copy_from

    module procedure image_get_pixels_real32
        type(wfpsf_image) :: copy
        integer :: nx, ny, status

        nx = 0
        ny = 0
        call self%get_shape(nx=nx, ny=ny, stat=status)
        allocate (array(nx, ny))
        if (status == wfpsf_ok) call copy%wrap(array, 1, status)
        if (status == wfpsf_ok) status = wfpsf_image_copy(self%pointer, copy%pointer)
        call report(status, stat, errmsg)
    end procedure image_get_pixels_real32

    module procedure image_get_pixels_real64
        type(wfpsf_image) :: copy
        integer :: nx, ny, status

        nx = 0
        ny = 0
        call self%get_shape(nx=nx, ny=ny, stat=status)
        allocate (array(nx, ny))
        if (status == wfpsf_ok) call copy%wrap(array, 1, status)
        if (status == wfpsf_ok) status = wfpsf_image_copy(self%pointer, copy%pointer)
        call report(status, stat, errmsg)
    end procedure image_get_pixels_real64

    module procedure image_interleave
        integer :: i

        if (fits(images, n_x, n_y, dx, dy, stat, errmsg)) then
            call report(wfpsf_image_interleave(int(n_x, c_int64_t), int(n_y, c_int64_t), &
                [(images(i)%pointer, i = 1, size(images))], dx, dy, convention, self%pointer), &
                stat, errmsg)
        end if
    end procedure image_interleave

    module procedure image_deinterleave
        integer :: i

        if (fits(images, n_x, n_y, dx, dy, stat, errmsg)) then
            call report(wfpsf_image_deinterleave(self%pointer, int(n_x, c_int64_t), &
                int(n_y, c_int64_t), dx, dy, convention, &
                [(images(i)%pointer, i = 1, size(images))]), stat, errmsg)
        end if
    end procedure image_deinterleave

    ! The library cannot see how long the arrays are.
    function fits(images, n_x, n_y, dx, dy, stat, errmsg)
        type(wfpsf_image), intent(in) :: images(:)
        integer, intent(in) :: n_x, n_y
        real(real64), intent(in) :: dx(:), dy(:)
        integer, intent(out), optional :: stat
        character(len=*), intent(inout), optional :: errmsg
        logical :: fits
        character(len=*), parameter :: line = &
            "images, dx, dy: must have n_x * n_y elements each"

        fits = all([size(images), size(dx), size(dy)] == n_x * n_y)
        if (fits) return
        if (.not. present(stat)) error stop line
        stat = wfpsf_error_size
        if (present(errmsg)) errmsg = line
    end function fits

    module procedure image_finalize
        call self%destroy()
    end procedure image_finalize

end submodule wfpsf_image_procedures
