// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/spectrum.hpp"

#include "error/error.hpp"
#include "numerics/quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Eigenvalues>

namespace wfpsf {

namespace {

// Second radiation constant h c / k (exact in the SI since 2019), nm K.
constexpr double second_radiation_nm_k = 1.438776877503933e7;

// Points between two neighbouring kinks for a smooth source alone, over 5 nm or so.
constexpr int points_between_kinks = 5;

double require_sound(double density, double nm) {
    if (!(density >= 0 && std::isfinite(density)))
        fail(WFPSF_ERROR_RANGE, "sed = %g at %g nm: must be finite and not negative", density, nm);
    return density;
}

} // namespace

Sed tabulated_sed(SedUnit unit, std::span<const double> wavelength_nm,
                  std::span<const double> density) {
    if (wavelength_nm.size() < 2)
        fail(WFPSF_ERROR_SIZE, "count = %zu: a table needs 2 samples", wavelength_nm.size());
    std::vector<double> nm(wavelength_nm.begin(), wavelength_nm.end());
    std::vector<double> values(density.begin(), density.end());
    for (size_t i = 0; i < nm.size(); ++i) {
        if (!(std::isfinite(nm[i]) && nm[i] > (i > 0 ? nm[i - 1] : 0)))
            fail(WFPSF_ERROR_RANGE, "wavelength_nm[%zu] = %g: must be finite, positive and rising",
                 i, nm[i]);
        require_sound(values[i], nm[i]);
    }
    const auto at = [unit, nm, values = std::move(values)](double wavelength) {
        const auto above = std::ranges::upper_bound(nm, wavelength);
        const auto i = static_cast<size_t>(std::clamp<std::ptrdiff_t>(
            above - nm.begin(), 1, static_cast<std::ptrdiff_t>(nm.size()) - 1));
        const double part = (wavelength - nm[i - 1]) / (nm[i] - nm[i - 1]);
        return std::lerp(values[i - 1], values[i], part) *
               (unit == SedUnit::energy ? wavelength : 1);
    };
    return {at, std::move(nm)};
}

Sed power_law_sed(SedUnit unit, double exponent) {
    if (!(std::abs(exponent) <= 100))
        fail(WFPSF_ERROR_RANGE, "exponent = %g: must be -100..100", exponent);
    const double power = exponent + (unit == SedUnit::energy ? 1 : 0);
    // About 1000 nm, so that no power overflows.
    return {[power](double nm) { return std::pow(nm / 1000, power); }};
}

Sed black_body_sed(double temperature_k) {
    if (!(temperature_k >= 50 && temperature_k <= 1e9))
        fail(WFPSF_ERROR_RANGE, "temperature_k = %g: must be 50..1e9", temperature_k);
    // Photons: lambda^-4 / (exp(x) - 1), less the value at 1000 nm so that cold bodies keep a
    // scale.
    const auto logarithm = [temperature_k](double nm) {
        const double x = second_radiation_nm_k / (nm * temperature_k);
        return -4 * std::log(nm / 1000) - x - std::log(-std::expm1(-x));
    };
    return {[logarithm](double nm) { return std::exp(logarithm(nm) - logarithm(1000)); }};
}

Sed redshifted_sed(Sed sed, double redshift) {
    if (!(redshift > -1 && redshift <= 1000))
        fail(WFPSF_ERROR_RANGE, "redshift = %g: must be above -1, up to 1000", redshift);
    const double stretch = 1 + redshift;
    for (double &nm : sed.kinks_nm)
        nm *= stretch;
    sed.photons = [rest = std::move(sed.photons), stretch](double nm) {
        return rest(nm / stretch);
    };
    return sed;
}

double Spectrum::mean_wavelength() const {
    double sum = 0;
    for (size_t i = 0; i < size(); ++i)
        sum += weight[i] * wavelength[i];
    return sum;
}

Light monochromatic(double wavelength) {
    return [wavelength](double) { return Spectrum{{wavelength}, {1}}; };
}

Light detected_light(const Band &band, const Sed &sed) {
    const size_t last = band.throughput.size() - 1;
    const double blue = band.wavelength_nm(0), red = band.wavelength_nm(last);
    if (!sed.kinks_nm.empty() && (sed.kinks_nm.front() > blue || sed.kinks_nm.back() < red))
        fail(WFPSF_ERROR_RANGE, "sed: its table covers %g..%g nm, the band %s needs %g..%g nm",
             sed.kinks_nm.front(), sed.kinks_nm.back(), band.name, blue, red);
    std::vector<double> kinks;
    for (size_t i = 0; i <= last; ++i)
        kinks.push_back(band.wavelength_nm(i));
    std::ranges::copy_if(sed.kinks_nm, std::back_inserter(kinks),
                         [&](double nm) { return nm > blue && nm < red; });
    std::ranges::sort(kinks);

    Light light_of = [kinks, sed, band,
                      samples = std::vector(band.throughput.begin(), band.throughput.end())](
                         double path) {
        Band own = band;
        own.throughput = samples; // which live as long as this does
        Spectrum light;
        double total = 0;
        GaussLegendreRules rules;
        for (size_t i = 0; i + 1 < kinks.size(); ++i) {
            const double half = (kinks[i + 1] - kinks[i]) / 2;
            const double middle = (kinks[i + 1] + kinks[i]) / 2;
            const double turns = std::numbers::pi * path * 1e9 * (1 / kinks[i] - 1 / kinks[i + 1]);
            const GaussLegendre &rule =
                rules.of(points_between_kinks + gauss_legendre_points(turns, 1e-10));
            for (size_t k = 0; k < rule.x.size(); ++k) {
                const double nm = middle + half * rule.x[k];
                const double photons =
                    throughput(own, nm) * require_sound(sed.photons(nm), nm) * rule.w[k] * half;
                if (photons == 0)
                    continue;
                light.wavelength.push_back(nm * 1e-9);
                light.weight.push_back(photons);
                total += photons;
            }
        }
        if (!(total > 0 && std::isfinite(total)))
            fail(WFPSF_ERROR_ARGUMENT, "sed: the band %s detects %g of its light", own.name, total);
        for (double &weight : light.weight)
            weight /= total;
        return light;
    };
    light_of(0); // fails now, if at all
    return light_of;
}

Spectrum together(std::span<const Spectrum> spectra) {
    std::vector<std::pair<double, double>> points;
    for (const Spectrum &spectrum : spectra)
        for (size_t i = 0; i < spectrum.size(); ++i)
            points.emplace_back(spectrum.wavelength[i],
                                spectrum.weight[i] / static_cast<double>(spectra.size()));
    std::ranges::sort(points);
    Spectrum sum;
    for (const auto &[wavelength, weight] : points)
        if (!sum.wavelength.empty() && sum.wavelength.back() == wavelength) {
            sum.weight.back() += weight;
        } else {
            sum.wavelength.push_back(wavelength);
            sum.weight.push_back(weight);
        }
    return sum;
}

WavelengthRule::WavelengthRule(const Spectrum &spectrum, size_t n, double largest_share) {
    const auto [blue, red] = std::ranges::minmax(spectrum.wavelength);
    middle_ = (1 / blue + 1 / red) / 2;
    half_ = (1 / blue - 1 / red) / 2;
    exact_ = spectrum.size() == 1 ||
             static_cast<double>(n) > largest_share * static_cast<double>(spectrum.size());
    if (exact_) {
        wavelength_ = spectrum.wavelength;
        return;
    }

    // Stieltjes: orthonormal polynomials p_j on the spectrum's own points,
    // beta_(j+1) p_(j+1) = (x - alpha_j) p_j - beta_j p_(j-1).
    std::vector<double> x, p(spectrum.size(), 1), below(spectrum.size(), 0);
    for (const double wavelength : spectrum.wavelength)
        x.push_back(scaled(wavelength));
    for (size_t j = 0; j < n; ++j) {
        double alpha = 0;
        for (size_t i = 0; i < p.size(); ++i)
            alpha += spectrum.weight[i] * x[i] * p[i] * p[i];
        alpha_.push_back(alpha);
        double norm = 0;
        for (size_t i = 0; i < p.size(); ++i) {
            const double above = (x[i] - alpha) * p[i] - (j > 0 ? beta_.back() : 0) * below[i];
            below[i] = p[i];
            p[i] = above;
            norm += spectrum.weight[i] * above * above;
        }
        const double beta = std::sqrt(norm);
        beta_.push_back(beta);
        for (double &value : p)
            value /= beta;
    }
    const auto size = static_cast<Eigen::Index>(alpha_.size());
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> jacobi;
    jacobi.computeFromTridiagonal(Eigen::Map<Eigen::VectorXd>(alpha_.data(), size),
                                  Eigen::Map<Eigen::VectorXd>(beta_.data(), size - 1));
    for (Eigen::Index k = 0; k < size; ++k) {
        wavelength_.push_back(1 / (middle_ + half_ * jacobi.eigenvalues()[k]));
        const double first = jacobi.eigenvectors()(0, k);
        gauss_.push_back(first * first);
        polynomial_.push_back(polynomials(wavelength_.back()));
    }
}

std::vector<double> WavelengthRule::polynomials(double wavelength) const {
    const double x = scaled(wavelength);
    std::vector<double> p{1};
    double below = 0;
    for (size_t j = 0; j + 1 < alpha_.size(); ++j) {
        const double above =
            ((x - alpha_[j]) * p[j] - (j > 0 ? beta_[j - 1] : 0) * below) / beta_[j];
        below = p[j];
        p.push_back(above);
    }
    return p;
}

std::vector<double> WavelengthRule::moments(const Spectrum &spectrum) const {
    std::vector<double> x, p(spectrum.size(), 1), below(spectrum.size(), 0);
    for (const double wavelength : spectrum.wavelength)
        x.push_back(scaled(wavelength));
    std::vector<double> moments(size());
    for (size_t j = 0; j < size(); ++j)
        for (size_t i = 0; i < x.size(); ++i) {
            moments[j] += spectrum.weight[i] * p[i];
            const double above =
                ((x[i] - alpha_[j]) * p[i] - (j > 0 ? beta_[j - 1] : 0) * below[i]) / beta_[j];
            below[i] = std::exchange(p[i], above);
        }
    return moments;
}

std::vector<double> WavelengthRule::weights(const Spectrum &spectrum) const {
    if (exact_) {
        std::vector<double> weights(size());
        for (size_t i = 0; i < spectrum.size(); ++i) {
            const auto at = std::ranges::lower_bound(wavelength_, spectrum.wavelength[i]);
            weights[static_cast<size_t>(at - wavelength_.begin())] += spectrum.weight[i];
        }
        return weights;
    }
    const std::vector<double> moment = moments(spectrum);
    std::vector<double> weights(size());
    for (size_t k = 0; k < size(); ++k)
        for (size_t j = 0; j < size(); ++j)
            weights[k] += gauss_[k] * polynomial_[k][j] * moment[j];
    return weights;
}

} // namespace wfpsf
