// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/colours.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

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

FringeErrors::FringeErrors(const WavelengthRule &rule, const std::vector<double> &weights,
                           const Spectrum &spectrum, double longest_path)
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

ColourChoice choose_wavelengths(const Spectrum &spectrum, double longest_path, double eps) {
    const auto [blue, red] = std::ranges::minmax(spectrum.wavelength);
    const double turns = std::numbers::pi * longest_path * (1 / blue - 1 / red);
    for (auto n = static_cast<size_t>(3 + turns / 6);; n += 1 + n / 16) {
        WavelengthRule rule(spectrum, n);
        const double error =
            rule.exact()
                ? 0
                : FringeErrors(rule, rule.own_weights(), spectrum, longest_path).of_image(blue);
        if (error <= eps)
            return {std::move(rule), error};
    }
}

} // namespace wfpsf
