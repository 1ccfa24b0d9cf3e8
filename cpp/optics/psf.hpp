// SPDX-License-Identifier: GPL-3.0-or-later
// The effective PSF, ready to be drawn anywhere: any number of stars, at any sub-pixel offset, at
// any sampling (section 4.1 of the paper).
#pragma once

#include "image/view.hpp"
#include "optics/component.hpp"
#include "optics/field.hpp"
#include "optics/large_stamp.hpp"
#include "optics/otf.hpp"

#include <span>
#include <vector>

namespace wfpsf {

// Immutable once made; draw() may be called from many threads.
class Psf {
  public:
    // Of one colour: wavefront in waves at settings.wavelength.
    Psf(std::shared_ptr<const Aperture> aperture, const Wavefront &wavefront,
        const PsfSettings &settings);

    // `field` is what make_fields() gives for the other arguments and settings.radius.
    Psf(const Optics &optics, Light light, const PsfSettings &settings, Field field);

    // image(i, j) = flux * (fraction of the light that a native pixel centred there receives) /
    // N^2, N = oversampling samples a native pixel; or that is added. So the sum over an infinite
    // image is the flux, at any N. Without pixel response the light is the density at the sample's
    // centre times the pixel's area, whose sum is the flux if N samples it finely enough. An image
    // that reaches beyond settings().radius is drawn from its diffraction image anew, in strips.
    // Returns an estimate of the error, of the peak pixel.
    enum class Drawing { overwrites, adds };
    template <class T>
    double draw(const Star &star, int64_t oversampling, View<T> image,
                Drawing drawing = Drawing::overwrites, const Manners &manners = {}) const;

    // What drawing beyond settings().radius takes; nothing otherwise.
    StampMemory draw_memory(const Star &star, int64_t oversampling, int64_t nx, int64_t ny) const;

    // Adds stars to an image, each on the pixels within settings().radius of it along both axes;
    // stars out of reach of the image add nothing. The threads share the image's rows, and the bits
    // do not depend on their number.
    template <class T>
    void add(std::span<const Star> stars, int64_t oversampling, View<T> image, int threads) const;

    // Its derivatives by the factors of wavefronts that are added, in waves at
    // settings().wavelength: as fields, to be drawn within `radius` native pixels.
    std::vector<Field> changes(std::span<const Wavefront> by, double radius) const {
        return make_field_changes(field_, optics_, by, settings_, radius);
    }

    // Its transfer function: see Otf.
    Otf otf(double eps) const;

    const PsfSettings &settings() const { return settings_; }
    double lit_area() const { return optics_.aperture->area(); } // m^2
    int64_t nodes() const { return field_.nodes; }
    // What it is a sum of.
    std::vector<Component> components() const;
    int64_t grid_size() const { return field_.grid_size; }
    double grid_step() const {
        return settings_.pixel_scale / static_cast<double>(field_.per_pixel);
    }                                                      // radians
    double error_estimate() const { return field_.error; } // numerical, of the peak pixel
    double model_error() const {
        return field_.model_error;
    }                                           // of the pupil's description, likewise
    double peak() const { return field_.peak; } // largest fraction of the light in one pixel

  private:
    Optics optics_;
    Light light_;
    PsfSettings settings_;
    Field field_;
};

// PSFs of several sources that share their monochromatic images.
std::vector<Psf> make_psfs(const Optics &optics, std::span<const Light> lights,
                           const PsfSettings &settings, const Manners &manners = {});

} // namespace wfpsf
