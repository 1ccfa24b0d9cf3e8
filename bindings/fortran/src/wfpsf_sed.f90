! SPDX-License-Identifier: GPL-3.0-or-later
submodule(wfpsf) wfpsf_sed_procedures
    use, intrinsic :: iso_c_binding, only: c_int64_t
    use wfpsf_c
    use wfpsf_common, only: report
    implicit none

contains

    module procedure sed_create_table
        type(c_ptr) :: created
        integer(c_int64_t) :: n
        integer :: status

        ! A negative count makes the library refuse arrays of different sizes.
        n = size(wavelength_nm, kind=c_int64_t)
        if (size(density, kind=c_int64_t) /= n) n = -1
        status = wfpsf_sed_create_table(unit, n, wavelength_nm, density, created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure sed_create_table

    module procedure sed_create_power_law
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_sed_create_power_law(unit, exponent, created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure sed_create_power_law

    module procedure sed_create_black_body
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_sed_create_black_body(temperature_k, created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure sed_create_black_body

    module procedure sed_create_redshifted
        type(c_ptr) :: created
        integer :: status

        status = wfpsf_sed_create_redshifted(sed%pointer, redshift, created)
        call self%destroy()
        self%pointer = created
        call report(status, stat, errmsg)
    end procedure sed_create_redshifted

    module procedure sed_destroy
        call wfpsf_sed_destroy(self%pointer)
        self%pointer = c_null_ptr
    end procedure sed_destroy

    module procedure sed_photon_density
        integer(c_int64_t) :: n

        n = size(wavelength_nm, kind=c_int64_t)
        if (size(photons, kind=c_int64_t) /= n) n = -1
        call report(wfpsf_sed_photon_density(self%pointer, n, wavelength_nm, photons), stat, errmsg)
    end procedure sed_photon_density

    module procedure sed_finalize
        call self%destroy()
    end procedure sed_finalize

end submodule wfpsf_sed_procedures
