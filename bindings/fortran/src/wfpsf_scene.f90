! SPDX-License-Identifier: GPL-3.0-or-later
! Catalogues, scenes and exposures.
submodule(wfpsf) wfpsf_scene_procedures
    use, intrinsic :: iso_c_binding, only: c_char, c_int64_t
    use wfpsf_c
    use wfpsf_common, only: c_text, report
    implicit none

contains

    module procedure catalogue_create
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_catalogue_create(positions, brightness, created)
        call self%destroy()
        self%pointer = created
        self%origin = merge(1.0_real64, 0.0_real64, positions == wfpsf_positions_detector)
        call report(status, stat, errmsg)
    end procedure catalogue_create

    module procedure catalogue_destroy
        call wfpsf_catalogue_destroy(self%pointer)
        self%pointer = c_null_ptr
    end procedure catalogue_destroy

    module procedure catalogue_add_colour
        type(c_ptr) :: source
        real(real64) :: wavelength
        integer(c_int32_t) :: number
        integer :: status

        wavelength = 0
        if (present(wavelength_nm)) wavelength = wavelength_nm
        source = c_null_ptr
        if (present(sed)) source = sed%pointer
        number = -1
        status = wfpsf_catalogue_add_colour(self%pointer, wavelength, source, number)
        if (present(colour)) colour = number + 1
        call report(status, stat, errmsg)
    end procedure catalogue_add_colour

    module procedure catalogue_add_stars
        integer(c_int32_t), allocatable :: numbers(:) ! left unallocated it is NULL
        integer(c_int64_t) :: n

        ! A negative count makes the library refuse arrays of different sizes.
        n = size(x, kind=c_int64_t)
        if (size(y) /= n .or. size(brightness) /= n) n = -1
        if (present(colour)) then
            if (size(colour) /= n) n = -1
            numbers = colour - 1
        end if
        call report(wfpsf_catalogue_add_stars(self%pointer, n, x - self%origin, y - self%origin, &
            brightness, numbers), stat, errmsg)
    end procedure catalogue_add_stars

    module procedure catalogue_add_galaxies
        integer(c_int32_t), allocatable :: numbers(:)
        real(real64), allocatable :: shear1(:), shear2(:)
        integer(c_int64_t) :: n

        n = size(x, kind=c_int64_t)
        if (size(y) /= n .or. size(brightness) /= n .or. size(sersic_index) /= n &
            .or. size(half_light_radius_arcsec) /= n) n = -1
        if (present(e1)) then
            if (size(e1) /= n) n = -1
            shear1 = e1
        end if
        if (present(e2)) then
            if (size(e2) /= n) n = -1
            shear2 = e2
        end if
        if (present(colour)) then
            if (size(colour) /= n) n = -1
            numbers = colour - 1
        end if
        call report(wfpsf_catalogue_add_galaxies(self%pointer, n, x - self%origin, &
            y - self%origin, brightness, numbers, sersic_index, half_light_radius_arcsec, shear1, &
            shear2), stat, errmsg)
    end procedure catalogue_add_galaxies

    module procedure catalogue_size
        call report(wfpsf_catalogue_size(self%pointer, count), stat, errmsg)
    end procedure catalogue_size

    module procedure catalogue_finalize
        call self%destroy()
    end procedure catalogue_finalize

    module procedure instrument_get_ab_zero_rate
        call report(wfpsf_instrument_ab_zero_rate(self%pointer, c_text(band), rate), stat, errmsg)
    end procedure instrument_get_ab_zero_rate

    module procedure scene_create
        type(c_ptr) :: created, seen
        integer :: status

        seen = c_null_ptr
        if (present(observation)) seen = observation%pointer
        status = wfpsf_scene_create(instrument%pointer, seen, c_text(band), sca, &
            catalogue%pointer, image%pointer, x0 - 1, y0 - 1, pointer_of(options), created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure scene_create

    module procedure scene_destroy
        call wfpsf_scene_destroy(self%pointer)
        self%pointer = c_null_ptr
    end procedure scene_destroy

    module procedure scene_get
        call report(wfpsf_scene_get(self%pointer, key, value), stat, errmsg)
    end procedure scene_get

    module procedure scene_get_group
        integer :: status

        status = wfpsf_scene_get_group(self%pointer, group - 1_c_int64_t, key, value)
        if (status == wfpsf_ok .and. key == wfpsf_scene_group_colour) value = value + 1
        call report(status, stat, errmsg)
    end procedure scene_get_group

    module procedure scene_groups_of
        integer :: status

        status = wfpsf_scene_groups_of(self%pointer, size(group, kind=c_int64_t), group)
        if (status == wfpsf_ok) group = group + 1
        call report(status, stat, errmsg)
    end procedure scene_groups_of

    module procedure scene_text
        integer(c_int64_t) :: length
        integer :: status

        length = 0
        status = wfpsf_scene_text(self%pointer, 0_c_int64_t, length=length)
        block
            character(kind=c_char, len=length + 1) :: buffer
            if (status == wfpsf_ok) &
                status = wfpsf_scene_text(self%pointer, length + 1, buffer)
            text = buffer(:length)
        end block
        call report(status, stat, errmsg)
    end procedure scene_text

    module procedure scene_render
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_scene_render(self%pointer, pointer_of(options), image%pointer, created)
        if (present(rendering)) then
            call rendering%destroy()
            rendering%pointer = created
        else
            call wfpsf_rendering_destroy(created)
        end if
        call report(status, stat, errmsg)
    end procedure scene_render

    module procedure scene_truth
        ! Rows that count from 1 here, from 0 in the library.
        integer, parameter :: counted(*) = [wfpsf_truth_group, wfpsf_truth_position_x, &
            wfpsf_truth_position_y, wfpsf_truth_centroid_x, wfpsf_truth_centroid_y, &
            wfpsf_truth_ipc_centroid_x, wfpsf_truth_ipc_centroid_y]
        type(c_ptr) :: through
        integer(c_int64_t), allocatable :: numbers(:)
        integer(c_int64_t) :: n
        integer :: status

        through = c_null_ptr
        if (present(kernel)) through = kernel%pointer
        n = size(values, 2, kind=c_int64_t)
        if (size(values, 1) /= wfpsf_truth_columns) n = -1
        if (present(sources)) then
            if (size(sources) /= n) n = -1
            numbers = sources - 1
        end if
        status = wfpsf_scene_truth(self%pointer, n, numbers, through, pointer_of(options), values)
        if (status == wfpsf_ok) values(counted, :) = values(counted, :) + 1
        call report(status, stat, errmsg)
    end procedure scene_truth

    module procedure scene_finalize
        call self%destroy()
    end procedure scene_finalize

    module procedure scene_store_create
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_scene_store_create(created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure scene_store_create

    module procedure scene_store_destroy
        call wfpsf_scene_store_destroy(self%pointer)
        self%pointer = c_null_ptr
    end procedure scene_store_destroy

    module procedure scene_store_memory
        call report(wfpsf_scene_store_memory(self%pointer, bytes), stat, errmsg)
    end procedure scene_store_memory

    module procedure scene_store_write
        call report(wfpsf_scene_store_write(self%pointer, c_text(path)), stat, errmsg)
    end procedure scene_store_write

    module procedure scene_store_read
        call report(wfpsf_scene_store_read(self%pointer, c_text(path)), stat, errmsg)
    end procedure scene_store_read

    module procedure scene_store_finalize
        call self%destroy()
    end procedure scene_store_finalize

    module procedure rendering_destroy
        call wfpsf_rendering_destroy(self%pointer)
        self%pointer = c_null_ptr
    end procedure rendering_destroy

    module procedure rendering_get
        call report(wfpsf_rendering_get(self%pointer, key, value), stat, errmsg)
    end procedure rendering_get

    module procedure rendering_finalize
        call self%destroy()
    end procedure rendering_finalize

    module procedure exposure_create
        type(c_ptr) :: created, effects
        integer :: status

        effects = c_null_ptr
        if (present(chain)) effects = chain%pointer
        status = wfpsf_exposure_create(instrument%pointer, observation%pointer, c_text(band), &
            catalogue%pointer, effects, pointer_of(options), created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure exposure_create

    module procedure exposure_destroy
        call wfpsf_exposure_destroy(self%pointer)
        self%pointer = c_null_ptr
    end procedure exposure_destroy

    module procedure exposure_path
        integer(c_int64_t) :: length
        integer :: status

        length = 0
        status = wfpsf_exposure_path(self%pointer, c_text(folder), sca, 0_c_int64_t, length=length)
        block
            character(kind=c_char, len=length + 1) :: buffer
            if (status == wfpsf_ok) &
                status = wfpsf_exposure_path(self%pointer, c_text(folder), sca, length + 1, buffer)
            path = buffer(:length)
        end block
        call report(status, stat, errmsg)
    end procedure exposure_path

    module procedure exposure_make
        integer(c_int32_t) :: answer
        integer :: status

        answer = 0
        status = wfpsf_exposure_make(self%pointer, sca, c_text(folder), pointer_of(options), answer)
        if (present(made)) made = answer == 1
        call report(status, stat, errmsg)
    end procedure exposure_make

    module procedure exposure_finalize
        call self%destroy()
    end procedure exposure_finalize

end submodule wfpsf_scene_procedures
