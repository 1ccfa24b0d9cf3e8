// SPDX-License-Identifier: GPL-3.0-or-later
// Fringes between distant parts of a pupil. They fade with the path between the two as the
// spectrum's visibility does, which the sharp ends of a band make last over many fringes.
#pragma once

#include "optics/far_spikes.hpp"
#include "optics/pupil_edges.hpp"

#include <array>
#include <span>
#include <vector>

namespace wfpsf {

// What goes with the colour beside the path is a polynomial in 1 / wavelength through its values at
// a few of them: this many complex numbers.
inline constexpr size_t far_colours = 8;
struct ColourWaves {
    std::array<double, far_colours> re, im;
};

// In pairs, which vector instructions add.
[[gnu::always_inline]] inline double total(std::array<double, far_colours> sum) {
    static_assert(far_colours == 8);
    for (size_t m = 0; m < 4; ++m)
        sum[m] += sum[m + 4];
    return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

// Weights of Lagrange's cubic through the samples -1, 0, 1, 2 at 0 <= s < 1.
struct CubicWeights {
    double w[4];
    [[gnu::always_inline]] explicit CubicWeights(double s) {
        const double a = s + 1, b = s - 1, c = s - 2;
        constexpr double sixth = 1.0 / 6;
        w[0] = -s * b * c * sixth;
        w[1] = a * b * c / 2;
        w[2] = -a * s * c / 2;
        w[3] = a * s * b * sixth;
    }
    // From the sample -1 on.
    [[gnu::always_inline]] void read(const ColourWaves *wave, size_t colour, double &re,
                                     double &im) const {
        re = w[0] * wave[0].re[colour];
        im = w[0] * wave[0].im[colour];
        for (int k = 1; k < 4; ++k) {
            re += w[k] * wave[k].re[colour];
            im += w[k] * wave[k].im[colour];
        }
    }
};

// By a path difference and colour: the integral, over a spectrum that is one there and zero at the
// other colours, of sqrt(wavelength / mean) exp(2 pi i path / wavelength).
class Visibility {
  public:
    Visibility() = default; // none
    Visibility(const FarSource &source, double longest);

    const std::array<double, far_colours> &wavenumbers() const { return wavenumber_; }
    double middle() const { return middle_; } // wavenumber of the wave that the table leaves out
    double per_path() const { return per_path_; }
    double longest() const { return static_cast<double>(table_.size()) - 4.001; } // entries
    double longest_path() const { return longest() / per_path_; }
    const ColourWaves *table() const { return table_.data(); } // from one entry before no path
    // Of all colours together; no longer path has more.
    double most(double path) const;

    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.middle_, self.per_path_, self.wavenumber_, self.table_, self.most_);
    }

  private:
    double middle_ = 0, per_path_ = 0;
    std::array<double, far_colours> wavenumber_{};
    std::vector<ColourWaves> table_;
    std::vector<double> most_;
};

// The integrals along straight edges, see far_spikes.hpp, by colour and position across. Edges are
// cut where the colours would not be enough for what differs between the band's ends.
class EdgeColours {
  public:
    struct Edge {
        SpikeAxes axes;
        double x, y, length; // middle, m
        size_t straight;     // that it is part of
        double reach;        // across, native pixels
        double usual;        // that matters to any edge but one that it meets, see goes_on()
    };

    // `reach`: across, native pixels, of the longest edge. Short ones send their light wider: theirs
    // is up to twice that; and of edges that go on, with each other, `onwards` times as much.
    EdgeColours(const FarSource &source, const PupilEdges &edges, const Visibility &visibility,
                double reach, double onwards = 1);

    const std::vector<Edge> &edges() const { return edges_; }
    double per_across() const { return per_across_; }

    // From two steps before the edge's -reach on; times the pixel's and the blur's response to fringes with
    // light from (x, y).
    std::vector<ColourWaves> waves(size_t edge) const;
    std::vector<ColourWaves> waves(size_t edge, double x, double y) const;
    // Of the pixel and the blur in a direction of length one, native pixels squared.
    double variance(double ux, double uy) const;

    // A point of an edge: its share of the integral, and its wave from one position to the next.
    struct Node {
        double x, y;
        std::array<double, far_colours> weight;
        ColourWaves wave, step;
    };
    struct Response {
        Covariance blur;                        // in the pupil's frame
        double width;                           // of the pixel
        std::array<double, far_colours> cycles; // per metre and native pixel
    };

  private:
    std::vector<Node> nodes(const FarSource &source,
                            const std::array<double, far_colours> &wavenumber,
                            const Edge &edge) const;
    std::vector<ColourWaves> table(std::vector<Node> nodes, double reach) const;

    Response response_;
    std::vector<Edge> edges_;
    std::vector<std::vector<Node>> nodes_; // by edge
    double per_across_;
};

// Whether a straight edge meets another one where the outline turns by little: their ends send light
// together far across.
bool goes_on(const Junction &junction);

// The largest of all.
double most(std::span<const ColourWaves> waves);

} // namespace wfpsf
