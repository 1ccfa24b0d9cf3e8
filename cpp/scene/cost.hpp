// SPDX-License-Identifier: GPL-3.0-or-later
// What drawing takes, in seconds of one thread and in bytes: measured on one kind of machine
// (docs/scene.md), good to a factor of two there. Plans compare ways with each other; only ratios
// matter to the choice.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace wfpsf::cost {

inline double digits(double eps) {
    return std::max(1.0, -std::log10(eps));
}
// As PSFs' cost goes: 1 a digit at 7 digits.
inline double costly_digits(double eps) {
    return 7 * std::pow(digits(eps) / 7, 1.7);
}

// A PSF that reaches `radius` native pixels, of light of a relative bandwidth (0: one colour).
inline double psf(double radius, double eps, double bandwidth) {
    if (bandwidth > 0)
        return costly_digits(eps) * (5e-4 + 2.5e-6 * radius * (radius + 100));
    const double per_area = radius <= 64 ? 2.7e-6 : 8.5e-6;
    return digits(eps) / 6 * (0.7e-3 + per_area * radius * radius);
}

inline double psf_memory(double radius, double eps, double bandwidth) {
    constexpr double least = 3e6;
    return least +
           (bandwidth > 0 ? 1000 * digits(eps) * radius * (radius + 45) : 1400 * radius * radius);
}

// A stamp of `pixels` pixels straight from the diffraction image, beyond the radius made before.
inline double large_stamp(double pixels, double radius, double bandwidth) {
    const double wavelengths = bandwidth == 0 ? 1 : 10 + 2 * bandwidth * radius;
    return wavelengths * 3e-6 * pixels;
}

// A PSF of all of a detector whose optics vary: n + 1 exact ones for every degree n of its polynomials,
// which reach less far the higher the degree.
inline double shared_psf(double radius, double eps, double bandwidth, bool varies) {
    if (!varies)
        return psf(radius, eps, bandwidth);
    constexpr double falls = 2.3, nearest = 2.5; // native pixels
    double time = 0, reach = 20 * std::pow(falls, digits(eps) - 1);
    for (int fields = 2; reach > nearest; ++fields) {
        time += 0.75 * fields * psf(std::min(radius, reach), eps, bandwidth);
        reach /= falls;
    }
    return time;
}

inline double shared_psf_memory(double radius, double eps, double bandwidth, bool varies) {
    const double terms = std::max(1.0, 8 * digits(eps) - 8);
    return varies ? 500 * terms * std::pow(radius + 12, 2) : psf_memory(radius, eps, bandwidth);
}

// A star's stamp of width^2 pixels from a field made to `eps`, of so many native pixels' radius.
inline double stamp(double width, double radius, double eps) {
    return 0.8e-6 + 0.15e-9 * (5 + digits(eps)) * width * (width + 2 * 5 * radius);
}

// One of many stars' stamps, of width^2 pixels, each of which may lack that share of the light.
inline double shared_stamp(double width, double left_out) {
    return 0.3e-6 + 2e-8 * std::pow(digits(left_out), 3) + 0.9e-9 * width * width;
}

// What so many stars take beside, to get the PSFs of their places: cells, or for each its own.
inline double places(double stars, double width, double left_out) {
    const double one = 2.5e-5 + 0.4e-9 * std::pow(digits(left_out), 3) * width * width *
                                    std::sqrt(60 / std::max(60.0, width));
    const double cells = 64 * std::sqrt(1.5e-5 / left_out);
    return std::min(stars * one, cells * (1e-4 + 1.1e-7 * width * width));
}

// Far light on that many pixels of an image of so many, drawn by itself; and from tables.
inline double far_light(double pixels, double image) {
    return 1e-4 + 6e-10 * image + 2e-8 * pixels;
}
inline double far_blocks(double pixels) {
    return 1e-5 + 3.5e-9 * pixels;
}

// What they are made from.
constexpr double making_far_light = 0.07, far_light_memory = 14e6;
inline double far_tables(double radius, bool varies) {
    const double native = 4 * radius * radius;
    return varies ? 9 * making_far_light + 1.5e-6 * native : making_far_light + 5e-7 * native;
}

// While they are made.
inline double far_tables_memory(double radius, bool varies) {
    return (varies ? 9 : 1) * (far_light_memory + 160 * radius * radius);
}

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
