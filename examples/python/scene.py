#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Stars and galaxies on a part of one of Roman's detectors: how each is drawn, what it costs, how
far a pixel may be off, and what is true of three of them."""
import numpy as np
import wfpsf

SIDE, X0, Y0 = 512, 1800, 1800  # the part of the detector, and its first pixel
STARS, GALAXIES = 200, 100

random = np.random.default_rng(42)


def places(count):
    return X0 + SIDE * random.random(count), Y0 + SIDE * random.random(count)


catalogue = wfpsf.Catalogue("detector", "electrons")
star_flux, galaxy_flux = 10**random.uniform(1, 4, STARS), 10**random.uniform(2, 3, GALAXIES)
catalogue.add_stars(*places(STARS), star_flux)
ellipticity, angle = 0.3 * random.random(GALAXIES), 2 * np.pi * random.random(GALAXIES)
catalogue.add_galaxies(*places(GALAXIES), galaxy_flux,
                       sersic_index=random.choice([1.0, 2.0], GALAXIES),
                       half_light_radius_arcsec=random.uniform(0.2, 0.6, GALAXIES),
                       e1=ellipticity * np.cos(angle), e2=ellipticity * np.sin(angle))

# No pixel is off by more than a twentieth of a noise of 10 electrons.
roman = wfpsf.Instrument("roman-c9")
scene = wfpsf.Scene(roman, "J129", 7, catalogue, (SIDE, SIDE), X0, Y0, scene_noise=0.05,
                    scene_variance=100)
print(scene)

image = wfpsf.zeros((SIDE, SIDE), dtype=np.float32)
rendering = scene.render(image)
print("drawn: %.0f sources with %.0f exact PSFs, %.3g of %.3g electrons"
      % (rendering.drawn, rendering.exact_psfs, image.pixels.sum(dtype=float),
         star_flux.sum() + galaxy_flux.sum()))
print("a pixel is off by %.3f electrons at most, %.3f are allowed; %.2f s, %.2f s expected"
      % (rendering.error_estimate, scene.error_allowed, rendering.time, scene.time_expected))

truth = scene.truth([0, 1, 2], wfpsf.IPCKernel(0.02, 0.002))
print("\nstar   electrons  group     x         y       sigma      e1       e2   sigma with IPC")
for k in range(3):
    print("%4d  %10.1f  %5d  %8.3f  %8.3f  %8.5f  %7.4f  %7.4f  %14.5f"
          % (k, truth["flux"][k], truth["group"][k], truth["centroid_x"][k],
             truth["centroid_y"][k], truth["sigma"][k], truth["e1"][k], truth["e2"][k],
             truth["ipc_sigma"][k]))
