// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/scaling.hpp"

#include "optics/polar_sums.hpp"
#include "optics/sum_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;

// How much of eps the polynomial gets, the interpolation, and what is left out where light is
// faint: terms, and digits.
constexpr double share_of_terms = 0.45, share_of_filters = 0.35, share_left_out = 0.15,
                 share_of_digits = 0.05;

// Filters for places that have so much less light each. One that errs by some part of all
// frequencies' light may err by more of the largest sample around.
constexpr double fainter = 1.0 / 16, safety = 2;
constexpr double single_rounding = 4e-7; // of sums in single precision, of the largest sample

// Rays are worth their while from so many fringes on that the colours differ by, if there are more
// than so many times as many that are not fainter than eps: spikes fall as the square of the
// distance. The images that rays start from are only sampled as finely as serves filters best, in
// cycles a sample.
constexpr double nearest_for_rays = 13, worthwhile = 2, band_for_rays = 0.3;

// Images at Chebyshev's points become the polynomial's terms.
void expand(std::vector<Plane<double>> &images) {
    const auto count = static_cast<double>(images.size());
    std::vector<std::vector<double>> matrix(images.size());
    for (size_t m = 0; m < images.size(); ++m)
        for (size_t k = 0; k < images.size(); ++k)
            matrix[m].push_back(
                (m == 0 ? 1 : 2) / count *
                std::cos(pi * static_cast<double>(m) * (static_cast<double>(k) + 0.5) / count));
    const int64_t nx = images[0].nx();
    Plane<double> terms(nx, static_cast<int64_t>(images.size()));
    for (int64_t y = 0; y < images[0].ny(); ++y) {
        std::fill_n(terms.view().data, nx * terms.ny(), 0.0);
        for (size_t m = 0; m < images.size(); ++m)
            for (size_t k = 0; k < images.size(); ++k)
                add_scaled(matrix[m][k], images[k].view().row(y), nx,
                           terms.view().row(static_cast<int64_t>(m)));
        for (size_t m = 0; m < images.size(); ++m)
            std::copy_n(terms.view().row(static_cast<int64_t>(m)), nx, images[m].view().row(y));
    }
}

} // namespace

// Through Chebyshev's points, the error of a wave exp(2 pi i W / lambda) is at most
// 2 (pi h W)^K / K! for K of them, where 1 / lambda ranges over 2h. An intensity is a sum over all
// pairs of points of such waves, W the pair's difference.
Scaling::Scaling(const ImageMaker &maker, double blue, double red, double eps)
    : blue_(blue), to_(maker.grid()), from_(to_.size) {
    middle_ = (1 / blue + 1 / red) / 2;
    half_ = (1 / blue - 1 / red) / 2;
    if (half_ == 0) {
        wavelengths_ = {blue};
        return;
    }
    const double turn = pi * half_ * maker.optics().wavelength;
    const WavefrontPairs pairs = maker.optics().aperture->pairs(maker.optics().wavefront);
    int terms = 0;
    double missed = 0;
    do
        missed = 2 * pairs.power(turn, ++terms);
    while (missed > std::max(share_of_terms * eps, AveragedSamples::rounding));
    for (int k = 0; k < terms; ++k)
        wavelengths_.push_back(1 / (middle_ + half_ * std::cos(pi * (k + 0.5) / terms)));
    const double nearest = nearest_for_rays / (maker.bandwidth() * std::log(red / blue));
    const double fringed = 1 / (pi * maker.bandwidth() * std::sqrt(eps));
    if (std::min(to_.half(), fringed) > worthwhile * nearest) {
        coarser_ = std::max(1.0, band_for_rays / maker.bandwidth());
        rays_from_ = nearest;
    }
    const double bandwidth = coarser_ * maker.bandwidth();
    samples_.emplace(maker.unaveraged(bandwidth, share_of_filters * eps));
    const double area = maker.optics().aperture->area(), unit = area * area;
    economy_.filters.push_back({samples_->interpolator(), INFINITY});
    for (double faint = fainter; economy_.filters.back().interpolator.half_width() > 2;
         faint *= fainter) {
        const double asked = share_of_filters * eps / (safety * 2 * faint);
        const BandlimitedInterpolator interpolator(bandwidth, asked);
        if (interpolator.half_width() < economy_.filters.back().interpolator.half_width())
            economy_.filters.push_back({interpolator, faint * unit});
    }
    economy_.negligible = share_left_out * eps * unit;
    economy_.single_precision = share_of_digits * eps / single_rounding * unit;
    const double half = to_.half() / coarser_;
    int64_t reach = static_cast<int64_t>(std::ceil(half)) + samples_->interpolator().half_width();
    double missed_by_filters = maker.strength() * samples_->missed();
    if (rays_from_ < to_.half()) {
        const bool round = maker.optics().aperture->outline() == Outline::round;
        band_ = {bandwidth, bandwidth * (round ? std::numbers::sqrt2 : 2)};
        const double own = (share_of_filters + share_of_digits) * eps;
        polar_eps_ = own * unit;
        reach = std::max(reach, PolarSums::reach(band_, half, blue / red, own));
        missed_by_filters = std::max(missed_by_filters, share_of_filters * eps);
    }
    from_ = 2 * reach + 1;
    error_ = missed + (share_left_out + share_of_digits) * eps + missed_by_filters +
             AveragedSamples::rounding;
}

std::vector<double> Scaling::shares(double wavelength) const {
    std::vector<double> shares;
    for (const double own : wavelengths_) {
        double product = 1;
        for (const double other : wavelengths_)
            if (other != own)
                product *= (1 / wavelength - 1 / other) / (1 / own - 1 / other);
        shares.push_back(product);
    }
    return shares;
}

std::vector<ScaledColour> Scaling::scaled(const ColourSums &of, size_t begin, size_t end) const {
    std::vector<ScaledColour> colours;
    for (size_t k = begin; k < end; ++k) {
        const double wavelength = of.wavelengths[k];
        colours.push_back(
            {(1 / wavelength - middle_) / half_, blue_ / (coarser_ * wavelength), {}});
        for (const std::vector<double> &own : of.weights)
            colours.back().weights.push_back(own[k]);
    }
    return colours;
}

std::vector<Plane<double>> Scaling::sums(std::vector<Plane<double>> images, const ColourSums &all,
                                         std::span<const ColourSums> rules,
                                         const Progress &progress) const {
    const int64_t size = to_.size;
    std::vector<Plane<double>> sums;
    if (!samples_) {
        for (const std::vector<double> &own : rules[0].weights) {
            auto &sum = sums.emplace_back(Plane<double>::unset(size, size));
            for (int64_t y = 0; y < size; ++y)
                for (int64_t x = 0; x < size; ++x)
                    sum(x, y) = own[0] * images[0](x, y);
        }
        return sums;
    }
    for (size_t s = 0; s < rules[0].weights.size(); ++s)
        sums.emplace_back(size, size);
    expand(images);
    const ScalingTerms terms(std::move(images));
    double half = to_.half();
    if (rays_from_ < half)
        half = PolarSums(terms, band_, polar_eps_, economy_.negligible)
                   .set(scaled(all, 0, all.wavelengths.size()), rays_from_, half, sums,
                        progress.between(0, 0.5));
    const Progress rest = progress.between(rays_from_ < to_.half() ? 0.5 : 0, 1);
    ScaledTiles tiles(terms, size, half, economy_);
    for (size_t r = 0; r < rules.size(); ++r) {
        const ColourSums &rule = rules[r];
        const double beyond = r + 1 < rules.size() ? rules[r + 1].half : -1;
        // A few colours at a time: their weights stay in the cache.
        constexpr size_t together = 16;
        for (size_t begin = 0; begin < rule.wavelengths.size(); begin += together) {
            rest.report(
                (static_cast<double>(r) +
                 static_cast<double>(begin) / static_cast<double>(rule.wavelengths.size())) /
                static_cast<double>(rules.size()));
            const std::vector<ScaledColour> colours =
                scaled(rule, begin, std::min(begin + together, rule.wavelengths.size()));
            tiles.add(colours, std::min(rule.half, half), beyond, sums);
        }
    }
    return sums;
}

} // namespace wfpsf
