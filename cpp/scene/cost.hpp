// SPDX-License-Identifier: GPL-3.0-or-later
// What drawing takes, in seconds of one thread: measured on one kind of machine (docs/scene.md), good
// to a factor of two there. Plans compare ways with each other; only ratios matter to the choice.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace wfpsf::cost {

inline double digits(double eps) {
    return std::max(1.0, -std::log10(eps));
}

// A PSF that reaches `radius` native pixels, of light of a relative bandwidth (0: one colour).
inline double psf(double radius, double eps, double bandwidth) {
    const double per_area = radius <= 64 ? 2.7e-6 : 8.5e-6;
    const double wavelengths = bandwidth == 0 ? 1 : 8 + 2 * digits(eps);
    return wavelengths * (0.7e-3 + per_area * radius * radius);
}

// A stamp of `pixels` pixels straight from the diffraction image, beyond the radius made in advance.
inline double large_stamp(double pixels, double radius, double bandwidth) {
    const double wavelengths = bandwidth == 0 ? 1 : 10 + 2 * bandwidth * radius;
    return wavelengths * 3e-6 * pixels;
}

// A PSF of all of a detector whose optics vary: exact ones, and what they have in common.
inline double shared_psf(double radius, double eps, double bandwidth, bool varies) {
    if (!varies)
        return psf(radius, eps, bandwidth);
    const double exact = eps >= 1e-2 ? 16 : eps >= 1e-4 ? 38 : eps >= 1e-8 ? 100 : 300;
    const double samples = 64 * (radius + 2) * (radius + 2);
    return exact * psf(radius, eps, bandwidth) + 2.5e-9 * exact * exact * samples;
}

// A star's stamp of width^2 pixels from a field; rank: fields that are summed first.
inline double stamp(double width, double rank) {
    constexpr double per_pixel = 4;
    const double window = (width * per_pixel + 16) * (width * per_pixel + 16);
    const double beyond_cache = std::clamp(window * rank / 1e6, 1.0, 4.0);
    return 1.2e-6 + 1.1e-8 * width * width + 0.25e-9 * (rank - 1) * window * beyond_cache;
}

// Fields that a PSF is a sum of, when what is left out is that share of its peak.
inline double rank(double left_out) {
    return std::clamp(1 - 4.8 * std::log10(left_out / 0.08), 1.0, 60.0);
}

// Far light on that many pixels, drawn by itself; and from a table, where it is bright enough.
inline double far_light(double pixels) {
    return 1e-4 + 6e-9 * pixels;
}
inline double far_blocks(double pixels) {
    return 2e-6 + 7e-9 * pixels;
}

// What they are made from.
constexpr double making_far_light = 0.35;

// What galaxies are drawn with.
inline double otf(double bandwidth) {
    return bandwidth == 0 ? 0.1 : 0.8;
}

// A galaxy that fills so much by Fourier transform; beyond some size, on coarser grids.
inline double galaxy(double radius, double share) {
    const double width = std::min(2 * radius + 1, 1200.0);
    return 5e-6 + 3e-8 * width * width * (1 + 0.1 * digits(share));
}

} // namespace wfpsf::cost
