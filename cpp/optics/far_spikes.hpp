// SPDX-License-Identifier: GPL-3.0-or-later
// Diffraction spikes of broadband light. A straight edge with outward normal n gives the amplitude
//     n.k / (2 pi i k^2) * integral along it of (1 - W_n / n.k) exp(2 pi i (W + k.u)) ds,
// k = theta / lambda: the divergence theorem, to first order in the wavefront's slope W_n along n.
// Positions are native pixels from the star, in the pupil's frame.
#pragma once

#include "optics/field.hpp"
#include "optics/pupil_edges.hpp"
#include "optics/spectrum.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <span>
#include <vector>

namespace wfpsf {

// What the light far from the core follows from.
struct FarSource {
    const Optics &optics;
    const PsfSettings &settings;
    Spectrum spectrum; // a Gauss rule of a few points
    double nearest;    // native pixels

    double area() const { return optics.aperture->area(); }
    double pixel() const { return settings.pixel_scale; }
    // Cycles per native pixel that an intensity may hold.
    double bandwidth() const;
    // Mean of the wavelength's power.
    double mean_wavelength(int power = 1) const;
    Wavefront wavefront(double wavelength) const {
        return optics.wavefront.scaled(optics.wavelength / wavelength);
    }
};

// Along and across a spike.
struct SpikeAxes {
    double nx, ny;
    double along(double x, double y) const { return nx * x + ny * y; }
    double across(double x, double y) const { return nx * y - ny * x; }
};

// The pixels first..last of a row.
struct Run {
    int64_t first, last;
};

// The light of one edge by itself.
class Spike {
  public:
    SpikeAxes axes() const { return axes_; }
    double at(double x, double y) const;

    // Of the row of pixels at (x + i, y), i < n, those where the light may be above the floor.
    std::vector<Run> runs(double x, double y, int64_t n, double floor) const;
    // image[i] += flux * light at (x + i, y).
    template <class T> void add(double x, double y, double flux, std::span<T> image) const;

    double brightest(double r) const { return scale_ * most_ / (r * r); }
    // The distance from the spike's line beyond which the light at a distance r along it is fainter
    // than the floor.
    double half_width(double r, double floor) const;

  private:
    friend class SpikeTables;
    SpikeAxes axes_;
    double scale_;   // of the light
    double tail_;    // beyond the table: over the square of the distance across
    double most_;    // in the table
    double per_step_; // table entries a native pixel
    double reach_;   // of the table, native pixels
    // By position across: what is the same at all distances along, and what goes as their inverse.
    std::vector<std::array<double, 2>> profile_;
};

// What edges in about one direction make together beyond the sum of each: the fringes of a strut's
// two sides, for one.
class Fringes {
  public:
    double at(double x, double y) const;
    std::vector<Run> runs(double x, double y, int64_t n, double floor) const;
    template <class T> void add(double x, double y, double flux, std::span<T> image) const;
    double brightest(double r) const { return most_ / (r * r); }

  private:
    friend class SpikeTables;
    SpikeAxes axes_;
    double most_;
    double nearest_, per_along_, per_across_; // the table's first distance; entries a native pixel
    int64_t rows_ = 0, columns_ = 0;
    // On either side of the star: light times the distance's square by distance along and position
    // across. The last row holds for all distances beyond.
    std::array<std::vector<double>, 2> table_;
};

struct Spikes {
    std::vector<Spike> spikes;
    std::vector<Fringes> fringes;
};

Spikes make_spikes(const FarSource &source, const std::vector<StraightEdge> &edges);

} // namespace wfpsf
