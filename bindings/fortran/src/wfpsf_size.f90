! SPDX-License-Identifier: GPL-3.0-or-later
submodule(wfpsf) wfpsf_size_procedures
    use, intrinsic :: iso_c_binding, only: c_int64_t
    use wfpsf_c
    use wfpsf_common, only: report
    implicit none

contains

    module procedure image_encircled_energy
        call report(wfpsf_size_encircled_energy(self%pointer, x - 1, y - 1, radius, &
            pointer_of(options), fraction, error), stat, errmsg)
    end procedure image_encircled_energy

    module procedure image_ee_radius
        call report(wfpsf_size_ee_radius(self%pointer, x - 1, y - 1, fraction, method, &
            pointer_of(options), radius, error), stat, errmsg)
    end procedure image_ee_radius

    module procedure image_ee_radius_derivative
        type(c_ptr) :: other

        other = c_null_ptr
        if (present(second)) other = second%pointer
        call report(wfpsf_size_ee_radius_derivative(self%pointer, change%pointer, other, x - 1, &
            y - 1, fraction, pointer_of(options), derivative, error), stat, errmsg)
    end procedure image_ee_radius_derivative

    module procedure image_radial_profile
        integer(c_int64_t) :: n

        ! A negative count makes the library refuse arrays of different sizes.
        n = size(radii, kind=c_int64_t)
        if (size(profile, kind=c_int64_t) /= n) n = -1
        if (present(errors)) then
            if (size(errors, kind=c_int64_t) /= n) n = -1
        end if
        call report(wfpsf_size_profile(self%pointer, x - 1, y - 1, n, radii, pointer_of(options), &
            profile, errors), stat, errmsg)
    end procedure image_radial_profile

    module procedure image_profile_fwhm
        call report(wfpsf_size_profile_fwhm(self%pointer, x - 1, y - 1, pointer_of(options), fwhm, &
            error), stat, errmsg)
    end procedure image_profile_fwhm

    module procedure image_moment_sums
        call report(wfpsf_moments_sums(self%pointer, x - 1, y - 1, weight, &
            size(sums, kind=c_int64_t), sums), stat, errmsg)
    end procedure image_moment_sums

    module procedure image_fwhm
        call report(wfpsf_size_fwhm(self%pointer, x - 1, y - 1, fwhm), stat, errmsg)
    end procedure image_fwhm

end submodule wfpsf_size_procedures
