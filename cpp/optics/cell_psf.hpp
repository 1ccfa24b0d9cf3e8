// SPDX-License-Identifier: GPL-3.0-or-later
// Stars' stamps without interpolation: sums of light on the image's own samples, that all stars of a
// cell of a detector share. All over the detector many such are needed; within a cell a few tell
// nearly all, and the rest matter near the core alone.
#pragma once

#include "optics/add_stars.hpp"
#include "optics/field.hpp"
#include "optics/light_modes.hpp"

#include <memory>
#include <span>
#include <vector>

namespace wfpsf {

// Places (u, v) of a region that reaches from -1 to 1 along both axes.
struct DetectorCell {
    double u, v, half; // middle; half the width: 0 for one place alone
};

// How many cells along each axis it takes, a power of two, so that polynomials of degree 3 in the
// place miss no more than `lacks` of the light in a pixel; 0 if it takes more than `most`.
int64_t cells_across(std::span<const LightMode> modes, double lacks, int64_t most);

// The field of the place (u, v) from the sum of modes, on the grid of `like`, to be drawn within
// `radius` native pixels; pixels lack `lacks` of the light at most.
Field field_at(std::span<const LightMode> modes, double u, double v, const Field &like,
               double radius, double lacks);

// That of a coefficient of T_i(u) T_j(v) T_a(2 dx) T_b(2 dy): of where in a cell a star stands, and
// how far, in samples, from the middle of the one that holds it.
struct StampDegrees {
    int i, j, a, b;
};

// What stars give samples: such a polynomial. Its coefficients are held as S.
template <class S> class CellPsf {
  public:
    // Of all places, from the sum of modes on the grid of `like`, for stamps within `radius` native
    // pixels of a star, `oversampling` samples each. Pixels lack `lacks` of the light at most, if
    // that serves.
    CellPsf(std::span<const LightMode> modes, const Field &like, double radius,
            int64_t oversampling, double lacks, int threads);
    // Of a cell, from that of all places: pixels lack `lacks` more, beside what polynomials of
    // degree 3 miss.
    CellPsf(const CellPsf &all, const DetectorCell &cell, double lacks);

    // Do pixels lack no more than that? Light that pixels sample too coarsely, and that of the
    // interpolation's own error, no polynomial of the place in a pixel tells.
    bool serves(double lacks) const { return missed_ <= of_missed * lacks; }

    // Adds a star at (u, v) out to a radius; pixels lack so much more of its light at most.
    template <class T>
    void add(const Star &star, double u, double v, double radius, double lacks, StarRows<T> &rows);

  private:
    static constexpr double of_missed = 1.0 / 3; // of what pixels lack
    // For coefficients that are no brighter: so many and such rows as stars need that may lack that
    // much.
    void make_rows(double lacks);
    S *row(size_t k, int64_t y) {
        return light_->view().row(first_[static_cast<size_t>(y + half_)] + static_cast<int64_t>(k));
    }
    const S *row(size_t k, int64_t y) const {
        return light_->view().row(first_[static_cast<size_t>(y + half_)] + static_cast<int64_t>(k));
    }
    // How many coefficients count in samples so far from the middle.
    const std::vector<int64_t> &counts(double lacks);

    DetectorCell cell_;
    int64_t oversampling_, half_, width_;
    double missed_ = 0;                 // by the highest degree
    std::vector<StampDegrees> degrees_; // of the coefficients
    // So many samples from the middle, or farther.
    std::vector<std::vector<double>> brightest_;
    LeftOut left_out_;
    // Row after row of each coefficient that reaches there; where those of a row begin, and how
    // many reach how far from the middle.
    std::shared_ptr<Plane<S>> light_; // of all copies
    std::vector<int64_t> first_, held_;
    std::vector<int64_t> reach_; // of a coefficient, samples
    struct Counts {
        double lacks;
        std::vector<int64_t> by_distance;
    };
    std::vector<Counts> known_;
    std::vector<S> weights_;
    Plane<S> line_;
};

} // namespace wfpsf
