// SPDX-License-Identifier: GPL-3.0-or-later
// The field of light that stamps are drawn from: the diffraction image of a source of any spectrum,
// averaged over the native pixel and blurred, on a grid in step with the native pixels
// (section 4.1 of the paper; DESIGN: no folding, no image interpolant).
#pragma once

#include "error/progress.hpp"
#include "image/view.hpp"
#include "numerics/bandlimited.hpp"
#include "optics/aperture.hpp"
#include "optics/blur.hpp"
#include "optics/spectrum.hpp"
#include "optics/wavefront.hpp"

#include <memory>
#include <span>
#include <vector>

namespace wfpsf {

// How light reaches the focal plane: through a pupil, with a wavefront error of
// wavefront * wavelength metres.
struct Optics {
    std::shared_ptr<const Aperture> aperture;
    Wavefront wavefront; // waves at `wavelength`
    double wavelength;   // m
};

struct PsfSettings {
    double wavelength;  // m; of the wavefront, and of a PSF of one colour
    double pixel_scale; // native pixel, radians
    double eps;         // largest error of any pixel, in units of the peak pixel
    double radius;      // half size of the field made in advance, native pixels
    // The image's y axis runs against the pupil's: Roman's exit pupils are seen mirrored against
    // the detectors' science coordinates.
    bool mirrored = false;
    Covariance blur = {}; // of a Gaussian, native pixels^2: jitter and charge diffusion
    // The light of a sample is the average over a native pixel, else the density at its centre.
    bool pixel_response = true;
    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.wavelength, self.pixel_scale, self.eps, self.radius, self.mirrored, self.blur,
                self.pixel_response);
    }
};

// Position in samples of an image, the first one's centre at (0, 0).
struct Star {
    double x, y, flux;
};

struct Colour {
    double wavelength, weight; // m; of the light detected
};

struct Field {
    Field() = default;
    explicit Field(const BandlimitedInterpolator &of) : interpolator(of) {}
    BandlimitedInterpolator interpolator;
    int64_t per_pixel = 1; // grid samples a native pixel
    // Fraction of the light in a native pixel centred on each grid point; without pixel response,
    // the density of the light there times a native pixel's area.
    Plane<double> value;
    std::vector<Colour> colours; // that it is a sum of
    int64_t nodes = 0;           // of the pupil, over all wavelengths that were diffracted
    int64_t grid_size = 0;       // of the diffraction image that this was filtered from
    double peak = 0;             // largest fraction of the light in one pixel
    double faintest_peak = 0;    // smallest that the brightest pixel of a stamp may get
    double error = 0;            // estimate of the numerical error, of the stamp's peak pixel
    double model_error = 0;      // of the pupil's description, likewise
    // What grid and filters were chosen by.
    double shortest_wavelength = 0, longest_wavelength = 0, tolerance = 0;

    void find_peaks(); // peak and faintest_peak from value

    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.interpolator, self.per_pixel, self.value, self.colours, self.nodes,
                self.grid_size, self.peak, self.faintest_peak, self.error, self.model_error,
                self.shortest_wavelength, self.longest_wavelength, self.tolerance);
    }

    // out(i, j) = what a star gives pixel (first_x + i, first_y + j) of an image whose first pixel
    // is at (0, 0): see Psf::draw().
    template <class T>
    void draw(const Star &star, int64_t oversampling, int64_t first_x, int64_t first_y,
              View<T> out) const;
};

// One field a light, all from the same monochromatic images, reaching `radius` native pixels.
// Made ever better until the estimate meets settings.eps, or it is clear that it cannot.
std::vector<Field> make_fields(const Optics &optics, std::span<const Light> lights,
                               const PsfSettings &settings, double radius,
                               const Manners &manners = {});

// The field of other optics behind the same aperture, on the grid and with the filters of one that
// make_fields() gave for the same settings and as large a radius or a larger one: of its
// wavelengths, or of fewer that are as good within the radius.
Field make_field_like(const Field &like, const Optics &optics, const PsfSettings &settings,
                      double radius);

// How that field answers to wavefronts that are added, in the unit of the optics' own: its
// derivatives by their factors, each to be drawn like a field. See Aperture::changes().
std::vector<Field> make_field_changes(const Field &like, const Optics &optics,
                                      std::span<const Wavefront> by, const PsfSettings &settings,
                                      double radius);

} // namespace wfpsf
