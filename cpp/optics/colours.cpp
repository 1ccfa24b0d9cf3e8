// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/colours.hpp"

#include "numerics/quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;

} // namespace

Shares shares_of(double eps, const Spectrum &spectrum) {
    const double for_colour = spectrum.size() > 1 ? eps / 2 : 0;
    return {for_colour, eps - for_colour};
}

double brightness(double path, double wavelength) {
    const double phase = pi * path / wavelength;
    return 1 / (1 + phase * phase);
}

size_t wavelengths_for(const Spectrum &spectrum, double path, double eps) {
    constexpr double soft_edges = 0.82; // of a band: they let so many do
    const auto [blue, red] = std::ranges::minmax(spectrum.wavelength);
    int points = 3;
    for (double part = 1; part > 1e-3; part *= 0.8) {
        const double tolerance = eps / brightness(part * path, blue);
        const double turns = pi * part * path * (1 / blue - 1 / red);
        if (tolerance < 1)
            points = std::max(points, gauss_legendre_points(turns, std::min(0.1, tolerance)));
    }
    return static_cast<size_t>(soft_edges * points + 0.5);
}

FringeErrors::FringeErrors(const WavelengthRule &rule, const Spectrum &spectrum,
                           double longest_path)
    // An eighth of a turn over half the range of 1 / wavelength.
    : step_(1 / (8 * rule.half_range())), worst_(static_cast<size_t>(longest_path / step_) + 2) {
    std::vector<std::complex<double>> sum(worst_.size());
    const auto add = [&](double wavelength, double weight) {
        const std::complex<double> turn = std::polar(1.0, 2 * pi * step_ / wavelength);
        std::complex<double> wave = weight;
        for (std::complex<double> &s : sum) {
            s += wave;
            wave *= turn;
        }
    };
    for (size_t i = 0; i < spectrum.size(); ++i)
        add(spectrum.wavelength[i], spectrum.weight[i]);
    const std::vector<double> weights = rule.weights(spectrum);
    for (size_t k = 0; k < rule.size(); ++k)
        add(rule.wavelengths()[k], -weights[k]);
    for (size_t i = 1; i < sum.size(); ++i)
        worst_[i] = std::max(worst_[i - 1], std::abs(sum[i]));
}

double FringeErrors::up_to(double path) const {
    return worst_[std::min(static_cast<size_t>(path / step_) + 1, worst_.size() - 1)];
}

double FringeErrors::of_image(double wavelength) const {
    double most = 0;
    for (size_t i = 1; i < worst_.size(); ++i)
        most =
            std::max(most, worst_[i] * brightness(step_ * static_cast<double>(i - 1), wavelength));
    return most;
}

} // namespace wfpsf
