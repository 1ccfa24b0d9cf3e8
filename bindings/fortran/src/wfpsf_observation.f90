! SPDX-License-Identifier: GPL-3.0-or-later
submodule(wfpsf) wfpsf_observation_procedures
    use, intrinsic :: iso_c_binding, only: c_char, c_int64_t
    use wfpsf_c
    use wfpsf_common, only: report
    implicit none

contains

    module procedure observation_create
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_observation_create(instrument%pointer, ra_deg, dec_deg, pa_deg, &
            pointer_of(options), created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure observation_create

    module procedure observation_create_on_date
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_observation_create_on_date(instrument%pointer, ra_deg, dec_deg, julian_date, &
            pointer_of(options), created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure observation_create_on_date

    module procedure observation_create_aimed
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_observation_create_aimed(instrument%pointer, sca, x - 1, y - 1, ra_deg, &
            dec_deg, pa_deg, pointer_of(options), created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure observation_create_aimed

    module procedure observation_destroy
        call wfpsf_observation_destroy(self%pointer)
        self%pointer = c_null_ptr
    end procedure observation_destroy

    module procedure observation_get
        call report(wfpsf_observation_get(self%pointer, sca, key, value), stat, errmsg)
    end procedure observation_get

    ! A negative size makes the library refuse arrays of different sizes.
    pure function common_size(sizes) result(n)
        integer(c_int64_t), intent(in) :: sizes(:)
        integer(c_int64_t) :: n

        n = merge(sizes(1), -1_c_int64_t, all(sizes == sizes(1)))
    end function common_size

    module procedure observation_sky_to_pixel
        integer(c_int64_t) :: n
        integer :: status

        n = common_size([size(ra_deg, kind=c_int64_t), size(dec_deg, kind=c_int64_t), &
            size(x, kind=c_int64_t), size(y, kind=c_int64_t)])
        if (present(undefined)) undefined = 0
        status = wfpsf_observation_sky_to_pixel(self%pointer, sca, n, ra_deg, dec_deg, x, y, undefined)
        if (status == wfpsf_ok) then
            x = x + 1
            y = y + 1
        end if
        call report(status, stat, errmsg)
    end procedure observation_sky_to_pixel

    module procedure observation_pixel_to_sky
        integer(c_int64_t) :: n

        n = common_size([size(x, kind=c_int64_t), size(y, kind=c_int64_t), &
            size(ra_deg, kind=c_int64_t), size(dec_deg, kind=c_int64_t)])
        if (present(undefined)) undefined = 0
        call report(wfpsf_observation_pixel_to_sky(self%pointer, sca, n, x - 1, y - 1, ra_deg, &
            dec_deg, undefined), stat, errmsg)
    end procedure observation_pixel_to_sky

    module procedure observation_find_sca
        integer(c_int64_t) :: n
        integer :: status

        n = common_size([size(ra_deg, kind=c_int64_t), size(dec_deg, kind=c_int64_t), &
            size(sca, kind=c_int64_t), size(x, kind=c_int64_t), size(y, kind=c_int64_t)])
        status = wfpsf_observation_find_sca(self%pointer, merge(1, 0, with_gaps), n, ra_deg, dec_deg, &
            sca, x, y)
        if (status == wfpsf_ok) then
            x = x + 1
            y = y + 1
        end if
        call report(status, stat, errmsg)
    end procedure observation_find_sca

    module procedure observation_get_bounds
        integer :: status

        x_first = 0
        x_last = 0
        y_first = 0
        y_last = 0
        status = wfpsf_observation_bounds(self%pointer, sca, merge(1, 0, with_gaps), x_first, x_last, &
            y_first, y_last)
        if (status == wfpsf_ok) then
            x_first = x_first + 1
            x_last = x_last + 1
            y_first = y_first + 1
            y_last = y_last + 1
        end if
        call report(status, stat, errmsg)
    end procedure observation_get_bounds

    module procedure observation_jacobian
        integer(c_int64_t) :: n

        n = common_size([size(x, kind=c_int64_t), size(y, kind=c_int64_t), &
            size(jacobian, 3, kind=c_int64_t), size(pixel_area, kind=c_int64_t), &
            size(y_angle_deg, kind=c_int64_t)])
        if (size(jacobian, 1) /= 2 .or. size(jacobian, 2) /= 2) n = -1
        if (present(undefined)) undefined = 0
        call report(wfpsf_observation_jacobian(self%pointer, sca, n, x - 1, y - 1, jacobian, &
            pixel_area, y_angle_deg, undefined), stat, errmsg)
    end procedure observation_jacobian

    module procedure observation_fits_header
        integer(c_int64_t) :: length
        integer :: status

        length = 0
        status = wfpsf_observation_fits_header(self%pointer, sca, 0_c_int64_t, length=length)
        block
            character(kind=c_char, len=length + 1) :: buffer
            if (status == wfpsf_ok) &
                status = wfpsf_observation_fits_header(self%pointer, sca, length + 1, buffer)
            text = buffer(:length)
        end block
        call report(status, stat, errmsg)
    end procedure observation_fits_header

    module procedure observation_finalize
        call self%destroy()
    end procedure observation_finalize

    module procedure wfpsf_get_julian_date
        call report(wfpsf_julian_date(year, month, day, hour, minute, second, julian_date), stat, &
            errmsg)
    end procedure wfpsf_get_julian_date

    module procedure wfpsf_get_sun_position
        call report(wfpsf_sun_position(julian_date, pointer_of(options), ra_deg, dec_deg), stat, &
            errmsg)
    end procedure wfpsf_get_sun_position

    module procedure wfpsf_check_pointing
        integer(c_int32_t) :: answer
        integer :: status

        answer = 0
        status = wfpsf_pointing_allowed(instrument%pointer, ra_deg, dec_deg, julian_date, &
            pointer_of(options), sun_angle_deg, answer)
        allowed = answer == 1
        call report(status, stat, errmsg)
    end procedure wfpsf_check_pointing

    module procedure wfpsf_get_best_pa
        call report(wfpsf_pointing_best_pa(instrument%pointer, ra_deg, dec_deg, julian_date, &
            pointer_of(options), pa_deg), stat, errmsg)
    end procedure wfpsf_get_best_pa

end submodule wfpsf_observation_procedures
