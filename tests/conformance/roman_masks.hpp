// SPDX-License-Identifier: GPL-3.0-or-later
// Roman's PSFs through its published masks.
#pragma once

#include "csv.hpp"
#include "handles.hpp"

#include <string>

inline constexpr double mask_scale_m = 1.17978731902147e-3;

Instrument make_roman();

// The peer's frame and field rule, eps 1e-10 over 17 pixels.
Options peer_options();

// Transmissions of the mask that a band sees through.
Pixels read_mask(int sca, const std::string &band);

struct MaskPlace {
    const Pixels &mask;
    double scale_m, axis_x, axis_y;
};
// The PSF of a mask with the aberrations of a row of psf_aberrations.csv; adds them to the options.
Psf make_masked(const Row &aberrations, const MaskPlace &place, double wavelength_nm,
                const Options &options);

// A star of flux 1 on the middle of a square stamp.
Pixels draw(const Psf &psf, int side, int oversampling);
