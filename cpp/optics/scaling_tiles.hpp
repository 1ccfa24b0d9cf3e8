// SPDX-License-Identifier: GPL-3.0-or-later
// The sums of Scaling, a tile at a time. Far from the axis there is little light: polynomials of
// fewer terms and shorter filters are as good there.
#pragma once

#include "image/view.hpp"
#include "numerics/bandlimited.hpp"
#include "optics/scaling_terms.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace wfpsf {

// Images of all colours, each to be made smaller about the axis.
class ScaledTiles {
  public:
    // A filter for places with no more light than `up_to`.
    struct Filter {
        BandlimitedInterpolator interpolator;
        double up_to;
    };
    // What is left out where there is little light: terms that are `negligible` together, and the
    // digits of double precision up to a brightness.
    struct Economy {
        std::vector<Filter> filters; // from the longest to the shortest
        double negligible, single_precision;
    };

    // Makes images of `size` samples on either axis, in the square within `half` of the axis.
    ScaledTiles(const ScalingTerms &terms, int64_t size, double half, const Economy &economy);

    // Adds the images of some colours to the sums, in all tiles that lie within `half` samples of
    // the axis, but not within `beyond`.
    void add(std::span<const ScaledColour> colours, double half, double beyond,
             std::span<Plane<double>> sums);

  private:
    class Sized;
    struct Tile {
        int64_t x0, x1, y0, y1;
    };
    struct Choice {
        size_t terms, filter;
        bool single_precision;
    };
    // What images are made of that lie among these samples of the terms.
    Choice choose(Range x, Range y) const;

    // Planes that a tile passes through.
    template <class T> struct Work {
        std::vector<Plane<T>> terms;
        Plane<T> combined, lines, turned;
        std::vector<Plane<T>> columns; // for each sum
    };
    template <class T>
    void add_tile(std::span<Sized> colours, const Tile &tile, Choice choice, Work<T> &work,
                  std::span<Plane<double>> sums) const;

    const ScalingTerms &terms_;
    int64_t size_;
    Range within_;
    const Economy &economy_;
    Work<double> double_;
    Work<float> single_;
};

} // namespace wfpsf
