// SPDX-License-Identifier: GPL-3.0-or-later
// The PSF all over a detector: a polynomial of the place, by Chebyshev's, whose coefficients are
// fields of light, made from exact PSFs at some places and held against exact ones at others.
#pragma once

#include "error/progress.hpp"
#include "optics/psf.hpp"

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

// How much of a PSF a star needs: the light within `radius` native pixels of it along both axes,
// and each of the fields that PSFs are sums of within a radius of its own; of those after, nothing.
struct StarDetail {
    double radius;
    std::span<const double> field_radii;
};

// Immutable once made.
class VaryingPsf {
  public:
    // `varies`: whether the optics differ from place to place at all.
    VaryingPsf(OpticsAt optics, bool varies, Light light, const PsfSettings &settings,
               const Region &region, const Manners &manners = {});

    // Outside the region: WFPSF_ERROR_RANGE.
    Psf at(double x, double y) const;

    // Adds stars as Psf::add() does, each with the PSF of its own place; place (x0, y0) is the
    // centre of the image's first native pixel.
    template <class T>
    void add(std::span<const Star> stars, double x0, double y0, int64_t oversampling, View<T> image,
             int threads) const;

    // Adds stars to rows first_row..last_row, each in its own detail and, off the region, with the
    // PSF of the nearest place in it.
    template <class T>
    void add_to_rows(std::span<const Star> stars, std::span<const StarDetail> details, double x0,
                     double y0, int64_t oversampling, View<T> image, int64_t first_row,
                     int64_t last_row) const;

    // What the first `rank` fields leave out: the largest fraction of the light in a native pixel,
    // at any place.
    double left_out(size_t rank) const { return left_out_[0][rank]; }
    // StarDetail::field_radii of stamps of a radius that lack no more than `left_out` in any pixel.
    std::vector<double> field_radii(double radius, double left_out) const;

    const PsfSettings &settings() const { return settings_; }
    // Estimates in units of the peak pixel, at any place: of all errors, of the interpolation
    // alone.
    double error_estimate() const { return error_; }
    double interpolation_error() const { return interpolation_error_; }
    int degree() const { return degree_; }             // of x and y together
    size_t rank() const { return mode_.size(); }       // fields held
    int64_t exact_psfs() const { return exact_psfs_; } // that were made for it
    int64_t memory() const;                            // bytes held

  private:
    struct Place {
        double x, y;
    };
    Place place(double u, double v) const; // of u, v in [-1, 1]
    bool is_inside(double x, double y) const;
    Field exact(double u, double v, double radius);
    // The light at the nodes of the present degree, by rows; `coarse`: that of half the degree.
    // Nodes that are new reach `radius` native pixels.
    std::vector<Plane<double>> refined(std::vector<Plane<double>> coarse, double radius,
                                       const Progress &progress);
    void expand(const std::vector<Plane<double>> &nodes, double radius);
    void find_left_out();
    // The radius within which the present degree errs by too much. Far from the core PSFs vary by
    // less, and a low degree will do.
    double measure(double radius);
    // Of the first modes, as many as there is room for.
    void weights(double x, double y, std::span<double> out) const;
    Field sum_at(double x, double y) const;
    template <class T, class DetailOf>
    void add_rows(std::span<const Star> stars, DetailOf detail_of, double x0, double y0,
                  int64_t oversampling, View<T> image, int64_t first_row, int64_t last_row) const;

    OpticsAt optics_;
    Light light_;
    PsfSettings settings_;
    Region region_;
    int degree_ = 0;
    int64_t exact_psfs_ = 0;
    double error_ = 0, interpolation_error_ = 0;
    double error_beyond_ = 0; // of the interpolation, where no higher degree is needed
    Field plain_;             // what the fields of all places have in common
    // Coefficients of T_i(x) T_j(y), the largest first.
    struct Mode {
        int i, j;
        double largest; // absolute value
        Plane<double> light;
    };
    std::vector<Mode> mode_;
    // left_out_[r][n]: beyond r native pixels, at most, with n modes taken.
    std::vector<std::vector<double>> left_out_;
};

} // namespace wfpsf
