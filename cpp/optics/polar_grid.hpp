// SPDX-License-Identifier: GPL-3.0-or-later
// Rays from the axis, whose samples stand apart by equal factors. They meet the sides of squares
// about the axis at even steps, and distances are those of the sides (Averbuch et al. 2008, SIAM J.
// Sci. Comput. 30, 764): so one filter along each axis leads from images to the rays, and one along
// and one across the rays back.
#pragma once

#include "image/view.hpp"
#include "optics/filter_table.hpp"
#include "optics/scaling_terms.hpp"

#include <span>
#include <type_traits>
#include <vector>

namespace wfpsf {

// One side of the squares: across the x axis or the y axis, in its positive or negative half.
struct Side {
    bool across_x;
    int64_t sign;
};

// What frequencies terms hold: no more than `along_axes` cycles a sample along an axis, and along
// any ray no more than `along_rays` for each sample of distance.
struct PolarBand {
    double along_axes, along_rays;
};

// Filters for places of so much light, each of which may miss some part of eps; for sums in single
// or double precision.
template <class T> class PolarFilters {
  public:
    struct Set {
        double up_to;
        FilterTable<T> terms, distances, rays; // of: the terms; rays, along them; rays, across
    };
    PolarFilters(const PolarBand &band, double eps);

    const Set &for_light(double light) const;
    double most_light() const { return sets_[0].up_to; }

    // What the longest ones miss: about as much as digits do in single precision.
    static constexpr double best = std::is_same_v<T, float> ? 1e-7 : 1e-9;

  private:
    std::vector<Set> sets_; // from the longest to the shortest
};

// Of an image, what lies farther than `inner` samples from the axis along either axis, but no
// farther than `outer`.
class PolarGrid {
  public:
    // The image is a sum of terms that are made smaller by factors between two ratios; what filters
    // along rays need beyond either end is `ends` of ln distance, and the longest miss `best`.
    PolarGrid(const ScalingTerms &terms, const PolarBand &band, double inner, double outer,
              double smallest_ratio, double largest_ratio, double ends, double best);

    double ends() const { return ends_; }
    double start() const { return start_; }     // ln distance in the terms of the first sample
    double length() const { return length_; }   // of a ray in ln distance
    double highest() const { return highest_; } // frequency in it
    int64_t rays() const { return rays_; }      // of a side

    // How many rays are sampled together, and transformed together; and how many terms can be.
    static constexpr int64_t sector = 64, batch = 8, most_terms = 32;

    // The terms on a sector's rays: so many samples a ray. Leaves out terms that are negligible
    // together; of the others, `deep` numbers a ray.
    template <class T> struct Sampled {
        size_t terms;
        int64_t deep;
        Plane<T> at; // row: distance; number: ray * deep + term
    };
    template <class T>
    void sample(const Side &side, Range rays, int64_t samples, double negligible,
                const PolarFilters<T> &filters, Sampled<T> &out) const;

    // What samples of `per_ray` the image is drawn from.
    Range drawn_from(int64_t per_ray) const;
    // A side of the image from these samples on its rays: (ray, distance).
    template <class T>
    void draw(const Side &side, const Plane<T> &on_rays, int64_t per_ray,
              const PolarFilters<T> &filters, Plane<double> &image) const;
    // Numbers that stand idle behind a row of rays.
    static const int64_t padding;

    // Bands of what stands on rays, in cycles a sample.
    static constexpr double band_of_distances = 0.25, band_of_rays = 0.35;

  private:
    template <int64_t vectors, class T>
    void sample(const Side &side, Range rays, int64_t samples,
                std::span<const FilterTable<T> *const> filters, Sampled<T> &out) const;
    double slope(int64_t ray) const { return (static_cast<double>(ray) - middle_ray_) * step_; }
    double place(double in_image, int64_t per_ray) const; // among a ray's samples

    int longest(double bandwidth) const {
        return BandlimitedInterpolator(bandwidth, best_).half_width();
    }

    const ScalingTerms &terms_;
    double best_, ends_;
    double inner_, outer_, smallest_, largest_; // ratios
    double start_, length_, highest_;
    double step_; // of rays, on a side that is one sample off the axis
    int64_t rays_;
    double middle_ray_;
};

} // namespace wfpsf
