// SPDX-License-Identifier: GPL-3.0-or-later
// The light of stars all over a detector: a polynomial of the place whose coefficients are fields of
// light, made from exact PSFs at ever more places. What those at new places have that those before
// did not tell is the error so far.
#pragma once

#include "error/progress.hpp"
#include "image/archive.hpp"
#include "optics/field.hpp"
#include "optics/light_modes.hpp"

#include <functional>
#include <span>
#include <vector>

namespace wfpsf {

// The optics at a place of the detector, pixels; the same aperture everywhere.
using OpticsAt = std::function<Optics(double x, double y)>;

// Places within, borders included.
struct Region {
    double x0, y0, x1, y1;
};

// How much of a PSF a star needs: the light within `radius` native pixels of it along both axes, but
// for that share of its light in any pixel.
struct StarDetail {
    double radius, left_out;
};

// Immutable once made.
class VaryingLight {
  public:
    // `varies`: whether the optics differ from place to place at all.
    VaryingLight(const OpticsAt &optics, bool varies, const Light &light,
                 const PsfSettings &settings, const Region &region, const Manners &manners = {});

    // That of one place. Outside the region: WFPSF_ERROR_RANGE.
    Field field(double x, double y) const;

    // Adds stars as Psf::add() does, each with the PSF of its own place, to a tenth of
    // settings().eps; place (x0, y0) is the centre of the image's first native pixel.
    template <class T>
    void add(std::span<const Star> stars, double x0, double y0, int64_t oversampling, View<T> image,
             int threads) const;

    // Each in its own detail and, off the region, with the PSF of the nearest place in it.
    template <class T>
    void add(std::span<const Star> stars, std::span<const StarDetail> details, double x0, double y0,
             int64_t oversampling, View<T> image, int threads) const;

    // From the core on errors fall as the noise of bright stars does, as the root of the light, down
    // to this share.
    static constexpr double error_far_off = 0.3;

    const PsfSettings &settings() const { return settings_; }
    // Estimates in units of the peak pixel, at any place: of all errors, of the interpolation
    // alone.
    double error_estimate() const { return error_; }
    double interpolation_error() const { return interpolation_error_; }
    int degree() const { return degree_; }             // of x and y together
    size_t rank() const { return mode_.size(); }       // fields held
    int64_t exact_psfs() const { return exact_psfs_; } // that were made for it
    int64_t memory() const;                            // bytes held

    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.settings_, self.region_, self.degree_, self.exact_psfs_, self.error_,
                self.interpolation_error_, self.error_beyond_, self.falls_, self.plain_,
                self.mode_);
    }

  private:
    friend class ArchiveReader;
    VaryingLight() = default; // what an archive holds goes in
    struct Place {
        double x, y;
    };
    bool is_inside(double x, double y) const;
    void expand(const OpticsAt &optics, const Manners &manners);
    // The radius within which polynomials err by too much that are so far off, times `safety`, so
    // many native pixels from the star or farther.
    double measure(const std::vector<double> &by_ring, double safety);
    Place scaled(double x, double y) const; // to [-1, 1], the nearest place there
    struct CellStars;
    std::vector<CellStars> by_cell(std::span<const size_t> which, std::span<const Place> places,
                                   std::span<const StarDetail> details) const;

    PsfSettings settings_{};
    Region region_{};
    int degree_ = 0;
    int64_t exact_psfs_ = 0;
    double error_ = 0, interpolation_error_ = 0;
    double error_beyond_ = 0; // of the interpolation, where no higher degree is needed
    // What errors may be at 0, 1, ... native pixels, of that at the core.
    std::vector<double> falls_;
    Field plain_;                 // what the fields of all places have in common
    std::vector<LightMode> mode_; // the brightest first
};

} // namespace wfpsf
