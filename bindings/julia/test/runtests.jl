# SPDX-License-Identifier: GPL-3.0-or-later
using Test
using Wfpsf
using Wfpsf: LibWfpsf

# An elliptical Gaussian of unit flux; first pixel's centre at (1, 1).
function gaussian(T, nx, ny; x, y, mxx, mxy, myy)
    determinant = mxx * myy - mxy^2
    chi2(u, v) = (myy * u^2 - 2mxy * u * v + mxx * v^2) / determinant
    return T[exp(-chi2(i - x, j - y) / 2) / (2pi * sqrt(determinant)) for i = 1:nx, j = 1:ny]
end

# The status with which a call fails.
function status_of(call)
    try
        call()
    catch failure
        failure isa WfpsfError || rethrow()
        return failure.code
    end
    return LibWfpsf.WFPSF_OK
end

@testset "Wfpsf" begin
    @testset "$subject" for subject in ("handle", "options", "instrument", "design", "image",
                                        "interleave", "observation", "sed", "psf", "colours", "varying_psf",
                                        "otf", "ipc", "varying_ipc", "chain", "scene", "moments",
                                        "size", "study", "doctests")
        include("$subject.jl")
    end
end
