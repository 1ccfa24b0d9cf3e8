// SPDX-License-Identifier: GPL-3.0-or-later
// The light far from a star that all stars of a colour share: tabulated once, then drawn on those
// blocks of pixels alone that are bright enough.
#pragma once

#include "image/view.hpp"
#include "optics/far_light.hpp"
#include "optics/psf.hpp"
#include "optics/varying_psf.hpp"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace wfpsf {

// Light about a star that stands in the middle, as a fraction of all of it in a native pixel at each
// sample.
struct SampledLight {
    int64_t per_pixel;   // samples a native pixel
    int64_t half;        // native pixels from the star to the borders
    Plane<float> sample; // the star's is at half * per_pixel along both axes

    SampledLight(int64_t samples, double radius); // a native pixel; native pixels
    // Far light beyond `inner`; what is below `floor` may be missing.
    void add(const FarLight &light, double inner, double floor);
    // A PSF out to its radius.
    void add(const Psf &psf);
};

class FarTable {
  public:
    FarTable(SampledLight light, double radius);
    double radius() const { return radius_; }
    int64_t memory() const { return light_.nx() * light_.ny() * int64_t{sizeof(float)}; }

    // The share of the light that add() gives to pixels at most `within` from the star along both
    // axes, about.
    double light(double within, double inner, double floor) const;

    // Adds a star's light to rows first_row..last_row of an image of native pixels, between `inner`
    // and the table's radius along either axis, where there is more than `floor` of it. That is a
    // share of the star's light.
    template <class T>
    void add(const Star &star, double inner, double floor, View<T> image, int64_t first_row,
             int64_t last_row) const;

  private:
    int64_t per_pixel_, half_;
    double radius_;
    // Spline coefficients, those of a row of one phase side by side:
    // coefficient (x * per_pixel + u, y * per_pixel + v) at (x, (y * per_pixel + v) * per_pixel + u).
    Plane<float> light_;
    struct Block {               // of some native pixels along both axes
        double brightest, light; // in a pixel; of all
        int64_t x, y;            // of its first pixel, from the star's pixel
    };
    std::vector<Block> blocks_; // the brightest first
};

// All over an image: the light of its middle, and how that of other places differs, as a polynomial
// through 3 x 3 places.
class FarTables {
  public:
    // Places of far light that tables are made from: the middle of the image first; that alone,
    // where light is the same everywhere.
    static std::vector<std::pair<double, double>> places(const Region &image, bool varies);

    struct Extent {
        double radius;             // where the tables end, native pixels
        double differences_radius; // those of the differences
        double floor;              // share of the light: what gets less may be missing
    };
    // `exact`, if there is one, is the PSF of the first place, and stands for its far light as far
    // as it reaches: from the pupil's edges then come the differences alone.
    FarTables(std::span<const FarLight> at_places, const Psf *exact, const Region &image,
              const Extent &extent);

    double radius() const { return middle_.radius(); }

    // As FarTable::add(), for a star that stands at (x, y) of the detector.
    template <class T>
    void add(const Star &star, double x, double y, double inner, double floor, View<T> image,
             int64_t first_row, int64_t last_row) const;
    const FarTable &middle() const { return middle_; } // of the first place
    int64_t memory() const;                            // bytes held

  private:
    Region image_;
    FarTable middle_;
    std::vector<FarTable> differences_; // coefficients of x, x^2, y, y^2, x y, ...
};

} // namespace wfpsf
