// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/colours.hpp"

#include "numerics/quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;

// Where the fringes of a band are looked at: an eighth of a turn over half of it apart.
struct Paths {
    double step;
    size_t count;
    Paths(double blue, double red, double longest)
        : step(blue < red ? 1 / (4 * (1 / blue - 1 / red)) : longest),
          count(static_cast<size_t>(longest / step) + 2) {}
};

// The sum of a wave in 1 / wavelength over a spectrum, by optical path difference.
using Fringes = std::vector<std::complex<double>>;
void add(std::span<const double> wavelength, std::span<const double> weight, const Paths &paths,
         Fringes &sums) {
    for (size_t i = 0; i < wavelength.size(); ++i) {
        const std::complex<double> turn = std::polar(1.0, 2 * pi * paths.step / wavelength[i]);
        std::complex<double> wave = weight[i];
        for (std::complex<double> &sum : sums) {
            sum += wave;
            wave *= turn;
        }
    }
}

// What a rule misses of a spectrum's fringes, where they are brightest. Light at a distance from
// the axis mixes all paths up to the longest there.
double error_of(const WavelengthRule &rule, const std::vector<double> &weights, const Paths &paths,
                const Brightness &brightness, Fringes of_spectrum) {
    std::vector<double> less = weights;
    for (double &weight : less)
        weight = -weight;
    add(rule.wavelengths(), less, paths, of_spectrum);
    double missed = 0, most = 0;
    for (size_t i = 1; i < paths.count; ++i) {
        missed = std::max(missed, std::abs(of_spectrum[i]));
        most = std::max(most, missed * brightness(paths.step * static_cast<double>(i - 1)));
    }
    return most;
}

// The range of a flat spectrum in 1 / wavelength that varies as much.
double flat_range(const Spectrum &spectrum) {
    double mean = 0, squares = 0;
    for (size_t i = 0; i < spectrum.size(); ++i)
        mean += spectrum.weight[i] / spectrum.wavelength[i];
    for (size_t i = 0; i < spectrum.size(); ++i)
        squares += spectrum.weight[i] * std::pow(1 / spectrum.wavelength[i] - mean, 2);
    return std::sqrt(12 * squares);
}

// How many points a rule needs that misses so little of a flat spectrum.
size_t usual_size(double range, double longest_path, const Brightness &brightness, double eps) {
    constexpr int places = 16;
    int most = 2;
    for (int i = 1; i <= places; ++i) {
        const double path = longest_path * i / places;
        if (const double missed = eps / brightness(path); missed < 1)
            most = std::max(most, gauss_legendre_points(pi * path * range, missed));
    }
    return static_cast<size_t>(most);
}

} // namespace

Brightness usual_brightness(double wavelength) {
    return [wavelength](double path) {
        const double phase = pi * path / wavelength;
        return 1 / (1 + phase * phase);
    };
}

ColourChoice choose_wavelengths(std::span<const Spectrum> spectra, double longest_path,
                                const Brightness &brightness, double eps, double largest_share) {
    const Spectrum all = together(spectra);
    const auto [blue, red] = std::ranges::minmax(all.wavelength);
    const Paths paths(blue, red, longest_path);
    std::vector<Fringes> fringes;
    for (const Spectrum &spectrum : spectra) {
        fringes.emplace_back(paths.count);
        add(spectrum.wavelength, spectrum.weight, paths, fringes.back());
    }
    constexpr double most = 500; // points: a rule takes the cube of their number to make
    const double share = std::min(largest_share, most / static_cast<double>(all.size()));
    for (size_t n = usual_size(flat_range(all), longest_path, brightness, eps);; n += 1 + n / 16) {
        ColourChoice choice{WavelengthRule(all, n, share), {}, 0};
        for (size_t s = 0; s < spectra.size() && choice.error <= eps; ++s) {
            choice.weights.push_back(choice.rule.weights(spectra[s]));
            if (!choice.rule.exact())
                choice.error = std::max(choice.error, error_of(choice.rule, choice.weights.back(),
                                                               paths, brightness, fringes[s]));
        }
        if (choice.error <= eps)
            return choice;
    }
}

} // namespace wfpsf
