# SPDX-License-Identifier: GPL-3.0-or-later
# What a call costs in Julia: see call_overhead.c.
# usage: WFPSF_LIBRARY=... julia --project=bindings/julia bench/call_overhead/call_overhead.jl
using Printf
using Wfpsf

const ROUNDS, SIDE = 20, 24

const psf = PSF(Instrument("wfirst-afta-c5"), 7, 1292)
const image = Image(Float64, SIDE, SIDE)
const star = draw(psf, SIDE, SIDE; x = 12.25, y = 13.5, oversampling = 4)
const x, y, flux = [12.25], [13.5], [1.0]

function measure(name, call, calls)
    least = minimum(1:ROUNDS) do _
        @elapsed for _ in 1:calls
            call()
        end
    end
    @printf("Julia    %-10s %10.0f ns\n", name, 1e9 * least / calls)
end

measure("property", () -> psf.peak, 100000)
measure("add_star", () -> add_stars!(image, psf, x, y, flux), 2000)
measure("draw", () -> draw!(image, psf, 12.25, 13.5), 2000)
measure("moments", () -> adaptive_moments(star), 2000)
