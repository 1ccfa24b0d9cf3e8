// SPDX-License-Identifier: GPL-3.0-or-later
// From diffraction to what stamps are drawn from: which grid an image is made on, and the filters
// that average it over the native pixel, blur it and interpolate it.
#pragma once

#include "numerics/bandlimited.hpp"
#include "optics/aperture.hpp"
#include "optics/blur.hpp"
#include "optics/field.hpp"

namespace wfpsf {

class ImageMaker {
  public:
    // Images that reach `radius` native pixels, of light no shorter than `shortest_wavelength`;
    // `tolerance` of an intensity in units of the unaberrated peak.
    ImageMaker(const Optics &optics, const PsfSettings &settings, double shortest_wavelength,
               double radius, double tolerance);

    const Optics &optics() const { return optics_; }
    const FocalGrid &grid() const { return grid_; }
    int64_t per_pixel() const { return per_pixel_; } // grid samples a native pixel
    int64_t margin() const {                         // that the averages take from the grid
        return static_cast<int64_t>(filter_.half_width());
    }
    size_t filter_terms() const { return filter_.terms.size(); }
    const BandlimitedInterpolator &interpolator() const { return samples_.interpolator(); }

    // The largest optical path difference between two parts of the pupil, as seen at a distance of
    // so many grid samples from the axis.
    double path(double distance) const;
    double longest_path() const;
    // How far from the axis it is at least that long.
    double distance(double path) const;

    // |A|^2 times this is the fraction of the light that a native pixel's solid angle receives; and
    // what that is at the peak of an unaberrated image.
    double scale(double wavelength) const;
    double unaberrated_peak(double wavelength) const;

    // The grid is that of the first wavelength, the others' steps in proportion.
    std::vector<Diffraction> diffract(std::span<const double> wavelengths, const FocalGrid &grid,
                                      const Progress &progress) const;
    // By the factors of wavefronts in waves: see Aperture::changes().
    std::vector<Plane<double>> changes(double wavelength, std::span<const Wavefront> by,
                                       const FocalGrid &grid) const;
    std::unique_ptr<const DiffractionStrips> diffract_in_strips(double wavelength) const;
    StripMemory strip_memory(double wavelength) const;
    // Bytes that one image on a grid takes while it is made.
    int64_t memory(const FocalGrid &grid) const;
    bool mirrored() const { return settings_.mirrored; }

    // Whole rows of an intensity averaged over the pixel and blurred, on the axes of the image.
    Plane<double> averaged(const Plane<double> &intensity) const;

    // What interpolates intensities on any grid, on which they hold no more than `bandwidth` cycles
    // a sample, to `eps` of the unaberrated peak.
    AveragedSamples unaveraged(double bandwidth, double eps) const {
        return AveragedSamples(bandwidth, 0, optics_.aperture->outline(), eps / strength_);
    }
    double bandwidth() const { return bandwidth(shortest_wavelength_); } // on the grid
    double strength() const { return strength_; } // of the spectrum that bounds an image's

    // What the averages and the interpolation add to an image's error, in units of the unaberrated
    // peak.
    double filter_error() const {
        return strength_ * (samples_.missed() + filter_.error) + AveragedSamples::rounding;
    }

  private:
    // What each sample is the average over, in grid samples.
    double window() const { return settings_.pixel_response ? static_cast<double>(per_pixel_) : 0; }
    double bandwidth(double shortest_wavelength) const {
        return optics_.aperture->diameter() * step_ / shortest_wavelength;
    }
    Wavefront at(double wavelength, const Wavefront &wavefront) const {
        return wavefront.scaled(optics_.wavelength / wavelength);
    }

    const Optics &optics_;
    const PsfSettings &settings_;
    int64_t per_pixel_;
    double step_;
    double strength_;
    AveragedSamples samples_;
    SeparableFilter filter_;
    FocalGrid grid_{};
    double for_diffraction_; // of the tolerance
    double shortest_wavelength_;
};

} // namespace wfpsf
