// SPDX-License-Identifier: GPL-3.0-or-later
// Diffraction spikes of broadband light. A straight edge with outward normal n gives the amplitude
//     n.k / (2 pi i k^2) * integral along it of (1 - W_n / n.k) exp(2 pi i (W + k.u)) ds,
// k = theta / lambda: the divergence theorem, to first order in the wavefront's slope W_n along n.
// Positions are native pixels from the star, in the pupil's frame.
#pragma once

#include "optics/far_rows.hpp"
#include "optics/field.hpp"
#include "optics/pupil_edges.hpp"
#include "optics/spectrum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace wfpsf {

// What the light far from the core follows from.
struct FarSource {
    const Optics &optics;
    const PsfSettings &settings;
    Spectrum spectrum;  // a Gauss rule of a few points
    double nearest;     // native pixels
    const Light &light; // that the spectrum is of

    double area() const { return optics.aperture->area(); }
    double pixel() const { return settings.pixel_scale; }
    // Cycles per native pixel that an intensity may hold.
    double bandwidth() const;
    // How far across from a spike's line tables hold its fringes, native pixels: see within().
    double fringe_reach() const { return 24 / std::max(1.0, bandwidth()); }
    // Mean of the wavelength's power.
    double mean_wavelength(int power = 1) const;
    Wavefront wavefront(double wavelength) const {
        return optics.wavefront.scaled(optics.wavelength / wavelength);
    }
};

// 1 in the inner two thirds of -1..1, smoothly to 0 outside.
[[gnu::always_inline]] inline double within(double t) {
    const double s = std::clamp(3 * (1 - std::abs(t)), 0.0, 1.0);
    return s * s * (3 - 2 * s);
}

// Spikes that are so close in angle, radians, may lie on each other.
inline constexpr double same_direction = 0.25;

// Radians that the outline may turn by at an edge's end for a curved edge beyond to belong to the
// edge's spike.
inline constexpr double widest_kink = 0.2;

// And the same for it to be the edge's own end that goes on.
inline constexpr double smooth_kink = 0.01;

// No fringes with rims and corners from there on, native pixels.
inline constexpr double fringes_end = 640;

// The light of one edge by itself, within 45 degrees of the spike; what is left is no spike.
class Spike {
  public:
    static constexpr size_t rounded_size = 256;

    const SpikeAxes &axes() const { return axes_; }

    // Adds fractions of the light, where they may be above the floor.
    void add(const PixelRow &row, double floor) const;

    // The most at a distance of r.
    double brightest(double r) const { return scale_ * (most_ + steepest_ / r) / (r * r); }
    // The most at a distance of r and near another spike's line.
    double brightest_off(double r, const SpikeAxes &other) const;
    // How far from its line a spike's light is above the floor, at the distance r along it.
    double half_width(double r, double floor) const;

    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.axes_, self.scale_, self.tail_, self.most_, self.steepest_, self.per_pixel_,
                self.reach_, self.constant_, self.slope_, self.fringe_reach_, self.rounding_,
                self.rounded_);
    }

  private:
    friend class SpikeTables;
    SpikeAxes axes_{};
    double scale_ = 0;     // of the light
    double tail_ = 0;      // beyond the table: over the square of the distance across
    double most_ = 0;      // in the table
    double steepest_ = 0;  // of what goes as the inverse of the distance
    double per_pixel_ = 0; // table entries
    double reach_ = 0;     // of the table, native pixels
    // By position across: what is the same at all distances along, and what goes as their inverse.
    std::vector<double> constant_, slope_;
    // What arcs at the ends leave of the light outside the fringes' table, by sqrt(rounding
    // across^2 / along).
    double fringe_reach_ = 0, rounding_ = 0;
    std::vector<double> rounded_;
};

// What edges in about one direction make together beyond the sum of each: the fringes of a strut's
// two sides, for one.
class Fringes {
  public:
    void add(const PixelRow &row, double floor) const;
    const SpikeAxes &axes() const { return axes_; }
    const std::vector<size_t> &members() const { return members_; } // of the straight edges
    double end() const { return end_; }

    // The most at a distance of r or more.
    double brightest(double r) const;

    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.axes_, self.members_, self.nearest_, self.end_, self.per_along_,
                self.per_across_, self.rows_, self.columns_, self.table_[0], self.table_[1],
                self.most_);
    }

  private:
    friend class SpikeTables;
    SpikeAxes axes_{};
    std::vector<size_t> members_;
    double nearest_ = 0, end_ = 0;          // native pixels
    double per_along_ = 0, per_across_ = 0; // entries a native pixel
    int64_t rows_ = 0, columns_ = 0;
    // On either side of the star: light times the distance's square by distance along and position
    // across.
    std::array<std::vector<double>, 2> table_;
    std::vector<double> most_; // from each distance on
};

struct Spikes {
    std::vector<Spike> spikes;
    std::vector<Fringes> fringes;
    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.spikes, self.fringes);
    }
};

Spikes make_spikes(const FarSource &source, const PupilEdges &edges);

} // namespace wfpsf
