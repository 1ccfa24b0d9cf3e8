// SPDX-License-Identifier: GPL-3.0-or-later
// Fringes between a spike and the halo: light of a straight edge and of the points of rims that
// send light its way. They fade with the path between the two as the spectrum's visibility does,
// which the sharp ends of a band make last over many fringes.
#pragma once

#include "optics/far_rims.hpp"
#include "optics/far_spikes.hpp"
#include "optics/pupil_edges.hpp"

#include <array>
#include <vector>

namespace wfpsf {

// What interpolates between a few colours of a band.
inline constexpr size_t far_colours = 8;
struct ColourWaves {
    std::array<double, far_colours> re, im;
};

// Of a spectrum that is a polynomial through values at some colours, in 1 / wavelength: integrals
// of what a path turns the light's phase by, for each colour's share of it.
class Visibility {
  public:
    Visibility(const FarSource &source, double longest);

    double middle() const { return middle_; } // wavenumber of the wave that the table leaves out
    const std::array<double, far_colours> &wavenumbers() const { return wavenumber_; }

    double per_path() const { return per_path_; }
    const std::vector<ColourWaves> &table() const { return table_; } // from the path -1 entries on
    // No longer path has more.
    double most(double path) const;

  private:
    double middle_, per_path_;
    std::array<double, far_colours> wavenumber_;
    std::vector<ColourWaves> table_;
    std::vector<double> most_;
};

class RimFringes {
  public:
    RimFringes(const FarSource &source, const PupilEdges &edges, RimPoints rims);

    // Adds fractions of the light, where they may be above the floor.
    void add(const PixelRow &row, double floor) const;

    // The most at a distance of r or more, on edges' spikes that are close to the one given.
    double brightest(double r, const SpikeAxes &spike) const;

  private:
    static constexpr double farthest = 640, rings_per_octave = 4; // native pixels

    // An edge with one point of an oval, which is in front on one side of the star.
    struct Pair {
        std::array<size_t, 2> point; // before the star and behind
        std::array<bool, 2> lit;     // likewise
        std::vector<ColourWaves>
            waves; // of the edge by position across, times the pixel's response
    };
    struct Edge {
        SpikeAxes axes;
        double x, y, length; // middle, m
        std::vector<Pair> pairs = {};
        std::vector<double> most = {}; // from each ring on
    };

    void add_pairs(const FarSource &source, Edge &edge) const;
    void add_rings(Edge &edge) const;
    double ring(size_t j) const {
        return rims_.nearest * std::exp2(static_cast<double>(j) / rings_per_octave);
    }

    RimPoints rims_;
    Visibility visibility_;
    double pixel_, scale_;
    double reach_, per_across_; // native pixels
    std::vector<Edge> edges_;
};

} // namespace wfpsf
