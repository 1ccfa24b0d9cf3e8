// SPDX-License-Identifier: GPL-3.0-or-later
// A filter band: its throughput curve and what follows from it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace wfpsf {

// Throughput at uniform steps, linear in between, zero outside. No more than one sample at either
// end is zero.
struct Band {
    const char *name;
    double first_nm, step_nm;
    std::span<const double> throughput; // dimensionless
    double thermal_background;          // e-/pixel/s
    size_t pupil_mask = 0;              // which of the instrument's pupil masks it is used with

    double wavelength_nm(size_t sample) const {
        return first_nm + step_nm * static_cast<double>(sample);
    }
};

// Limits and throughput-weighted mean wavelength of a throughput curve; no spectrum comes in.
struct BandWavelengths {
    double blue_nm, red_nm, effective_nm;
};

// Throughput at any wavelength; 0 outside the table. NaN and infinity: WFPSF_ERROR_NOT_FINITE.
double throughput(const Band &band, double wavelength_nm);

// Integral of the throughput over wavelength, in nm.
double integral_nm(const Band &band);

// Of the curve as tabulated: where the table ends, and the exact mean of the piecewise
// linear curve.
BandWavelengths tabulated_wavelengths(const Band &band);

// Indices of the samples that the thinning rule of GalSim 1.3.0, Bandpass.thin(1e-4), keeps.
std::vector<size_t> thinned_samples(const Band &band);

// Of the thinned curve, the mean by trapezoid sums over the samples kept. These are the paper's
// wavelengths (Kannawadi et al. 2016, Table 1); they differ from the tabulated curve's by up to
// 0.21 nm.
BandWavelengths thinned_wavelengths(const Band &band);

} // namespace wfpsf
