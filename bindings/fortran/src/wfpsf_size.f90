! SPDX-License-Identifier: GPL-3.0-or-later
submodule(wfpsf) wfpsf_size_procedures
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

    module procedure image_fwhm
        call report(wfpsf_size_fwhm(self%pointer, x - 1, y - 1, fwhm), stat, errmsg)
    end procedure image_fwhm

end submodule wfpsf_size_procedures
