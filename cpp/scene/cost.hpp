// SPDX-License-Identifier: GPL-3.0-or-later
// What drawing takes, in seconds of one thread: measured on one kind of machine (docs/scene.md), good
// to a factor of two there. Plans compare ways with each other; only ratios matter to the choice.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace wfpsf::cost {

// A PSF that reaches `radius` native pixels, of light of a relative bandwidth (0: one colour).
inline double psf(double radius, double eps, double bandwidth) {
    const double digits = std::max(1.0, -std::log10(eps));
    const double image = 0.5e-3 + 5e-6 * radius * radius * (0.7 + 0.05 * digits);
    const double wavelengths = bandwidth == 0 ? 1 : 4 + digits + bandwidth * radius;
    return wavelengths * image;
}

// A stamp of `pixels` pixels straight from the diffraction image, beyond the radius made in advance.
inline double large_stamp(double pixels, double radius, double bandwidth) {
    const double wavelengths = bandwidth == 0 ? 1 : 10 + bandwidth * radius;
    return wavelengths * 3e-6 * pixels;
}

// A PSF of all of a detector whose optics vary.
inline double shared_psf(double radius, double eps, double bandwidth, bool varies) {
    const double digits = std::max(1.0, -std::log10(eps));
    return psf(radius, eps, bandwidth) * (varies ? 15 + 7 * digits : 1);
}

// A star's stamp of width^2 pixels from a field; rank: fields that are summed first (0: none).
inline double stamp(double width, double rank) {
    constexpr double per_pixel = 4;
    const double window = width * per_pixel + 16;
    return 1.5e-6 + 4e-9 * width * width + 2e-9 * width * per_pixel * width +
           0.25e-9 * rank * window * window;
}

// Fields that a PSF of that accuracy is a sum of, when what is left out is that share of its peak.
inline double rank(double left_out) {
    return std::clamp(1 - 2 * std::log10(left_out / 0.05), 1.0, 20.0);
}

// Far light on that many pixels, drawn by itself; and from a table, where it is bright enough.
inline double far_light(double pixels) {
    return 1e-4 + 6e-9 * pixels;
}
inline double far_blocks(double pixels) {
    return 2e-6 + 7e-9 * pixels;
}

// What they are made from.
constexpr double making_far_light = 0.5;

// A galaxy on that many pixels by Fourier transform.
inline double galaxy(double pixels) {
    return 5e-6 + 3e-8 * pixels;
}

} // namespace wfpsf::cost
