// SPDX-License-Identifier: GPL-3.0-or-later
// The PSFs of a cell of a detector. All over the detector many fields are needed; within a cell one,
// that of its middle, tells nearly all, and a few more the rest, near the core alone.
#pragma once

#include "optics/add_stars.hpp"
#include "optics/field.hpp"
#include "optics/light_modes.hpp"

#include <span>
#include <vector>

namespace wfpsf {

// Places (u, v) of a region that reaches from -1 to 1 along both axes.
struct DetectorCell {
    double u, v, half; // middle; half the width: 0 for one place alone
};

// How many cells along each axis it takes, a power of two, so that polynomials of degree 2 in the
// place miss no more than `lacks` of the light in a pixel; 0 if it takes too many.
int64_t cells_across(std::span<const LightMode> modes, double lacks);

class CellPsf {
  public:
    // Of the sum of modes, on the grid of `like`, out to `radius` native pixels. Pixels lack
    // `lacks` of the light at most beside what the polynomials miss.
    CellPsf(std::span<const LightMode> modes, const DetectorCell &cell, const Field &like,
            double radius, double lacks);

    // Adds a star at (u, v) out to a radius; pixels lack so much more of its light at most.
    template <class T>
    void add(const Star &star, double u, double v, double radius, double lacks, StarRows<T> &rows);

  private:
    void add_degree(int a, int b, std::span<const LightMode> modes, double radius, double lacks);
    // Radii of the corrections.
    const std::vector<double> &radii(double radius, double lacks);

    DetectorCell cell_;
    Field middle_;                       // the degree 0
    std::vector<LightMode> corrections_; // of higher degrees
    LeftOut left_out_;
    Field sum_; // of a star's corrections
    struct Radii {
        double radius, lacks;
        std::vector<double> of_corrections;
    };
    std::vector<Radii> known_;
};

} // namespace wfpsf
