// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/image_maker.hpp"

#include "optics/resample.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wfpsf {

namespace {

// The intensity holds no frequency above diameter / wavelength. Sampling it at twice Nyquist's rate
// or somewhat finer keeps the filters short; a whole number of samples a native pixel lets all
// pixels of a stamp share one filter.
constexpr double widest_band = 0.25; // cycles per sample

} // namespace

ImageMaker::ImageMaker(const Optics &optics, const PsfSettings &settings,
                       double shortest_wavelength, double radius, double tolerance)
    : optics_(optics), settings_(settings),
      per_pixel_(static_cast<int64_t>(std::ceil(optics.aperture->diameter() * settings.pixel_scale /
                                                (widest_band * shortest_wavelength)))),
      step_(settings.pixel_scale / static_cast<double>(per_pixel_)),
      strength_(outline_strength(optics.aperture->outline(), optics.aperture->diameter(),
                                 optics.aperture->area())),
      samples_(bandwidth(shortest_wavelength), window(), optics.aperture->outline(),
               (settings.blur.none() ? 0.8 : 0.4) * tolerance / strength_),
      filter_{{{samples_.averaging(), samples_.averaging()}}, 0}, for_diffraction_(0.2 * tolerance),
      shortest_wavelength_(shortest_wavelength) {
    const auto samples = static_cast<double>(per_pixel_);
    const Covariance &blur = settings.blur;
    if (!blur.none())
        filter_ = blurring_filter(
            bandwidth(shortest_wavelength), window(),
            {blur.xx * samples * samples, blur.xy * samples * samples, blur.yy * samples * samples},
            0.4 * tolerance / strength_);
    const auto reach =
        static_cast<int64_t>(std::ceil(radius * samples)) + samples_.interpolator().half_width();
    const auto margin = static_cast<int64_t>(filter_.half_width());
    grid_ = {2 * (reach + margin) + 1, step_};
}

double ImageMaker::path(double distance) const {
    return optics_.aperture->diameter() *
           (distance * step_ + optics_.wavefront.slope_bound() * optics_.wavelength);
}

double ImageMaker::distance(double path) const {
    const double of_wavefront = optics_.wavefront.slope_bound() * optics_.wavelength;
    return std::max(0.0, path / optics_.aperture->diameter() - of_wavefront) / step_;
}

double ImageMaker::longest_path() const {
    return path(std::numbers::sqrt2 * grid_.half());
}

double ImageMaker::scale(double wavelength) const {
    const double wavelengths = settings_.pixel_scale / wavelength;
    return wavelengths * wavelengths / optics_.aperture->area();
}

double ImageMaker::unaberrated_peak(double wavelength) const {
    const double area = optics_.aperture->area();
    return scale(wavelength) * area * area;
}

std::vector<Diffraction> ImageMaker::diffract(std::span<const double> wavelengths,
                                              const FocalGrid &grid,
                                              const Progress &progress) const {
    std::vector<double> factors;
    for (const double wavelength : wavelengths)
        factors.push_back(wavelengths[0] / wavelength);
    return optics_.aperture->diffract_all(at(wavelengths[0], optics_.wavefront), wavelengths[0],
                                          factors, grid, for_diffraction_, progress);
}

std::vector<Plane<double>> ImageMaker::changes(double wavelength, std::span<const Wavefront> by,
                                               const FocalGrid &grid) const {
    return optics_.aperture->changes(at(wavelength, optics_.wavefront), by, wavelength, grid,
                                     for_diffraction_);
}

std::unique_ptr<const DiffractionStrips> ImageMaker::diffract_in_strips(double wavelength) const {
    return optics_.aperture->diffract_in_strips(at(wavelength, optics_.wavefront), wavelength,
                                                grid_, for_diffraction_);
}

StripMemory ImageMaker::strip_memory(double wavelength) const {
    return optics_.aperture->strip_memory(wavelength, grid_, for_diffraction_);
}

int64_t ImageMaker::memory(const FocalGrid &grid) const {
    const auto [fixed, per_row] =
        optics_.aperture->strip_memory(shortest_wavelength_, grid, for_diffraction_);
    return fixed + grid.size * per_row;
}

Plane<double> ImageMaker::averaged(const Plane<double> &intensity) const {
    View<const double> image = intensity.view();
    if (settings_.mirrored)
        image = {image.row(image.ny - 1), image.nx, image.ny, 1, -image.stride_y};
    return filtered(image, filter_);
}

} // namespace wfpsf
