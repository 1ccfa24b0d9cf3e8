// SPDX-License-Identifier: GPL-3.0-or-later
// What Scaling makes images of all colours from, and how bright that is where.
#pragma once

#include "image/view.hpp"

#include <cstdint>
#include <vector>

namespace wfpsf {

// From a sample on, up to another one.
struct Range {
    int64_t begin, end;
};

// Images of all colours as a polynomial: the sum over m of T_m(x) terms[m], |x| <= 1, T_m
// Chebyshev's; on square grids, the axis in their middle.
class ScalingTerms {
  public:
    // So many samples along an axis count as bright as the brightest of them.
    static constexpr int64_t spot = 16;

    explicit ScalingTerms(std::vector<Plane<double>> terms);

    size_t count() const { return terms_.size(); }
    int64_t size() const { return terms_[0].nx(); }
    double middle() const { return static_cast<double>(size() - 1) / 2; }
    const Plane<double> &operator[](size_t m) const { return terms_[m]; }

    // How many terms are enough among these samples, if the rest may count so much together, and
    // the most that any image can hold there.
    struct Light {
        size_t terms;
        double most;
    };
    Light light(Range x, Range y, double negligible) const;

    // The largest absolute value of a term at least so far from the axis.
    double largest_beyond(size_t m, double distance) const;

  private:
    std::vector<Plane<double>> terms_;
    std::vector<Plane<double>> brightest_;    // of each term, in spots and around them
    std::vector<std::vector<double>> beyond_; // of each term, from so many spots on
};

// One colour that the images are summed over.
struct ScaledColour {
    double x;
    double ratio;                // of the step of the images made to that of the terms
    std::vector<double> weights; // in each of the sums
};

} // namespace wfpsf
