// SPDX-License-Identifier: GPL-3.0-or-later
// A PSF against the converged figures of psf_c5/: stamps, adaptive moments, IPC and its
// derivatives, half-light radii.
#pragma once

#include "csv.hpp"
#include "handles.hpp"

#include <functional>

struct Tolerances {
    double stamp; // of the peak pixel
    double sigma; // relative; times sigma also for the centroid
    double e;
    double sensitivity;
};

using MakePsf = std::function<Psf(int32_t sca, double wavelength_nm)>;

// Every row of psf_c5_truth.csv with or without struts, in tests of its own.
void expect_truth(bool struts, const MakePsf &make, const Tolerances &tolerances);

// The native stamps, all of them of the pupil with struts.
void expect_stamps(const MakePsf &make, double tolerance);

// Options for comparisons: errors far below the tolerances, a field as large as a stamp needs.
Options precise_options(bool struts);

// 32 x 32 native pixels of a star on the optical axis, 16 samples a pixel; and the inner 16 x 16.
inline constexpr int oversampling = 16;
inline constexpr double sample_mas = 110.0 / oversampling;
Pixels draw_field(const Psf &psf, int native_pixels);
