# SPDX-License-Identifier: GPL-3.0-or-later

known = Dict(option.name => option for option in options())
@test known[:eps].default == 1e-6
@test known[:struts].integer
@test known[:moments_guess_sigma].default === nothing
@test occursin("first pixel at 1", known[:moments_guess_x].text)

# Every option is taken by some function, and no function takes an unknown one.
taken = (Wfpsf.PSF_OPTIONS..., Wfpsf.STAR_OPTIONS..., Wfpsf.MOMENTS_OPTIONS..., Wfpsf.SIZE_OPTIONS..., Wfpsf.CORRECT_OPTIONS...,
         Wfpsf.CHAIN_OPTIONS..., Wfpsf.OBSERVATION_OPTIONS..., Wfpsf.EXPOSURE_OPTIONS...,
         Wfpsf.RENDER_OPTIONS..., Wfpsf.TRUTH_OPTIONS..., Wfpsf.MAKE_OPTIONS..., :kernel_negative,
         :kernel_normalise, :ipc_fill)
@test issetequal(taken, (keys(known)..., :zernikes, :opd, :scene_store, :progress))

instrument = Instrument()
@test_throws ArgumentError PSF(instrument, 7, 1292; moments_tolerance = 1e-3)
@test status_of(() -> PSF(instrument, 7, 1292; eps = 1)) == LibWfpsf.WFPSF_ERROR_RANGE
@test status_of(() -> PSF(instrument, 7, 1292; eps = NaN)) == LibWfpsf.WFPSF_ERROR_NOT_FINITE
@test_throws InexactError PSF(instrument, 7, 1292; struts = 0.5)
defaults = (eps = nothing, struts = true)
@test PSF(psf -> psf.radius, instrument, 7, 1292; psf_radius = 5, defaults...) >= 5

Wfpsf.Options() do handle
    stored = Ref{Float64}()
    for (name, expected) in (:moments_guess_x => 9, :moments_guess_y => 9,
                             :moments_guess_sigma => 10)
        Wfpsf.set!(handle, name, 10)
        LibWfpsf.wfpsf_options_get(handle, Wfpsf.OPTIONS[name], stored)
        @test stored[] == expected
    end
end
