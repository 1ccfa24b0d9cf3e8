// SPDX-License-Identifier: GPL-3.0-or-later
// The effective PSF: diffraction image of a point source, averaged over the native pixel, ready to
// be sampled anywhere (section 4.1 of the paper; DESIGN: no folding, no image interpolant).
#pragma once

#include "image/view.hpp"
#include "numerics/bandlimited.hpp"
#include "optics/aperture.hpp"
#include "optics/component.hpp"
#include "optics/wavefront.hpp"

#include <memory>
#include <span>
#include <vector>

namespace wfpsf {

struct PsfSettings {
    double wavelength;  // m
    double pixel_scale; // native pixel, radians
    double eps;         // largest error of any pixel, in units of the peak pixel
    double radius;      // half size of the field made in advance, native pixels
    // The image's y axis runs against the pupil's: Roman's exit pupils are seen mirrored against
    // the detectors' science coordinates.
    bool mirrored = false;
};

// Position in samples of an image, the first one's centre at (0, 0).
struct Star {
    double x, y, flux;
};

// Immutable once made; draw() may be called from many threads.
class Psf {
  public:
    Psf(std::shared_ptr<const Aperture> aperture, const Wavefront &wavefront,
        const PsfSettings &settings);

    // out(i, j) = flux * (fraction of the light that a native pixel centred there receives) / N^2,
    // N = oversampling samples a native pixel, for a star at sample position (x, y). So the sum
    // over an infinite image is the flux, at any N. A stamp that reaches beyond settings().radius
    // gets a larger field of its own, at the cost of making it.
    template <class T>
    void draw(double x, double y, double flux, int64_t oversampling, View<T> out) const;

    // Adds stars to an image, each on the pixels within settings().radius of it along both axes;
    // stars out of reach of the image add nothing. The threads share the image's rows, and the bits
    // do not depend on their number.
    template <class T>
    void add(std::span<const Star> stars, int64_t oversampling, View<T> image, int threads) const;

    const PsfSettings &settings() const { return settings_; }
    std::vector<Component> components() const {
        return {{aperture_, wavefront_, settings_.wavelength, 1}};
    }
    double lit_area() const { return aperture_->area(); } // m^2
    int64_t nodes() const { return field_.nodes; }
    int64_t grid_size() const { return field_.value.nx(); }
    double grid_step() const {
        return settings_.pixel_scale / static_cast<double>(per_pixel_);
    }                                                      // radians
    double error_estimate() const { return field_.error; } // numerical, of the peak pixel
    double model_error() const {
        return field_.model_error;
    }                                           // of the pupil's description, likewise
    double peak() const { return field_.peak; } // largest fraction of the light in one pixel

  private:
    struct Field {
        explicit Field(const BandlimitedInterpolator &of) : interpolator(of) {}
        BandlimitedInterpolator interpolator;
        Plane<double> value; // fraction of the light in a native pixel centred on each grid point
        int64_t nodes = 0;
        double peak = 0, error = 0, model_error = 0;
    };
    Field make_field(double radius) const;
    Field make_field(double radius, double tolerance) const;
    template <class T>
    void draw_from(const Field &field, const Star &star, int64_t oversampling, int64_t first_x,
                   int64_t first_y, View<T> out) const;
    template <class T>
    void add_to_rows(std::span<const Star> stars, int64_t oversampling, View<T> image,
                     int64_t first_row, int64_t last_row) const;

    std::shared_ptr<const Aperture> aperture_;
    Wavefront wavefront_;
    PsfSettings settings_;
    int64_t per_pixel_; // samples of the focal grid in a native pixel
    Field field_;
};

} // namespace wfpsf
