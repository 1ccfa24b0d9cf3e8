// SPDX-License-Identifier: GPL-3.0-or-later
// Images of all wavelengths of a band from those of a few. At a place that is counted in
// wavelengths, theta / lambda, the amplitude depends on the wavelength by the wavefront's waves
// alone; and so does the intensity, by the differences of any two points of the pupil: smoothly, as
// a polynomial in 1 / lambda tells that goes through a few wavelengths. Each image then gets its
// size by band-limited interpolation, about the axis.
#pragma once

#include "error/progress.hpp"
#include "image/view.hpp"
#include "optics/aperture.hpp"
#include "optics/image_maker.hpp"
#include "optics/polar_sums.hpp"
#include "optics/scaling_tiles.hpp"

#include <cmath>
#include <optional>
#include <span>
#include <vector>

namespace wfpsf {

// Sums over colours, for places within `half` samples of the axis along either axis.
struct ColourSums {
    double half;
    std::vector<double> wavelengths;
    std::vector<std::vector<double>> weights; // for each sum those of the colours
};

// Colours of one spectrum, or more of the same wavelengths.
class Scaling {
  public:
    // To images on the maker's grid of wavelengths between the two, to `eps` of the unaberrated
    // peak.
    Scaling(const ImageMaker &maker, double blue, double red, double eps);

    // What images are needed of, and the grid that each is made on.
    const std::vector<double> &wavelengths() const { return wavelengths_; }
    FocalGrid grid(double wavelength) const {
        return {from_, coarser_ * to_.step * (wavelength / blue_)};
    }

    // Of the step of that grid to the maker's for the bluest light.
    double coarser() const { return coarser_; }

    // The parts that these images have in one of another wavelength.
    std::vector<double> shares(double wavelength) const;

    // What an image lacks in units of the unaberrated peak, if those that it is made of lack
    // nothing.
    double error() const { return error_; }

    // The sums of the images, which are used up: far from the axis over all colours, else by rules
    // from the outermost to the innermost.
    std::vector<Plane<double>> sums(std::vector<Plane<double>> images, const ColourSums &all,
                                    std::span<const ColourSums> rules,
                                    const Progress &progress = {}) const;

  private:
    // Colours begin..end-1 of some.
    std::vector<ScaledColour> scaled(const ColourSums &of, size_t begin, size_t end) const;

    double blue_, middle_ = 0, half_ = 0; // of 1 / wavelength
    FocalGrid to_;
    double coarser_ = 1; // step of the given images
    int64_t from_;       // samples of the given images along an axis
    std::vector<double> wavelengths_;
    std::optional<AveragedSamples> samples_; // unless there is one wavelength alone
    ScaledTiles::Economy economy_{};
    double rays_from_ = INFINITY; // samples off the axis
    PolarBand band_{};
    double polar_eps_ = 0;
    double error_ = 0;
};

} // namespace wfpsf
