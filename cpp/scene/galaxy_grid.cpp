// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/galaxy_grid.hpp"

#include "numerics/dispatch.hpp"
#include "numerics/phasor.hpp"

#include <algorithm>
#include <cmath>

namespace wfpsf {

namespace {

using Complex = std::complex<double>;

// exp(-2 pi i k shift), |k| <= reach.
WFPSF_VECTORISED
void fill_phases(int64_t reach, double shift, double scale, Complex *out) {
    auto *pairs = reinterpret_cast<double *>(out);
    for (int64_t i = 0; i <= 2 * reach; ++i) {
        double cosine, sine;
        phasor(static_cast<double>(i - reach) * shift, cosine, sine);
        pairs[2 * i] = scale * cosine;
        pairs[2 * i + 1] = -scale * sine;
    }
}

// The profile's transform at q = c + x (b + a x) for x = first, first + 1, ...
WFPSF_VECTORISED
void fill_profile(SersicTable::Lookup profile_of, double a, double b, double c, int64_t first,
                  int64_t count, double *out) {
    for (int64_t i = 0; i < count; ++i) {
        const auto x = static_cast<double>(first + i);
        out[i] = profile_of(c + x * (b + a * x));
    }
}

// sum += row * profile * (re + i im) * column
WFPSF_VECTORISED
void add_products(const double *profile, const double *re, const double *im, const Complex *column,
                  Complex row, int64_t count, Complex *sum) {
    const double u = row.real(), v = row.imag();
    const auto *phases = reinterpret_cast<const double *>(column);
    auto *sums = reinterpret_cast<double *>(sum);
    for (int64_t i = 0; i < count; ++i) {
        const double x = phases[2 * i], y = phases[2 * i + 1];
        const double p = profile[i] * (x * u - y * v), q = profile[i] * (x * v + y * u);
        sums[2 * i] += p * re[i] - q * im[i];
        sums[2 * i + 1] += p * im[i] + q * re[i];
    }
}

} // namespace

GalaxyGrid::GalaxyGrid(const Transfer &transfer, int64_t size, int64_t step,
                       const std::function<double(double)> &share)
    : size_(size), step_(step), fft_(size, size) {
    const double per_index = 1 / static_cast<double>(size * step);
    // The farthest that holds anything: what is shared may end before the transfer function does.
    reach_ = static_cast<int64_t>(std::ceil(transfer.cutoff / per_index));
    while (reach_ > 1 && share(static_cast<double>(reach_ - 1) * per_index) == 0)
        --reach_;
    const int64_t half = size / 2;
    for (int64_t ky = -reach_; ky <= reach_; ++ky) {
        const int64_t row = (ky % size + size) % size;
        // The folds whose sums are wanted: those with 0 <= kx mod size <= half.
        for (int64_t fold = -(reach_ / size + 1) * size; fold <= reach_; fold += size) {
            const int64_t first = std::max(fold, -reach_), last = std::min(fold + half, reach_);
            int64_t begin = reach_ + 1, end = -reach_;
            const size_t start = re_.size();
            std::vector<Complex> values;
            for (int64_t kx = first; kx <= last; ++kx) {
                const double u = static_cast<double>(kx) * per_index;
                const double v = static_cast<double>(ky) * per_index;
                const double part = share(std::hypot(u, v));
                const Complex value = part == 0 ? 0 : part * transfer.value(u, v);
                values.push_back(value);
                if (value != 0.0) {
                    begin = std::min(begin, kx);
                    end = kx + 1;
                }
                // Those on the edges of the half plane stand for both halves already.
                const double twice = kx == fold || kx == fold + half ? 1 : 2;
                curvature_ += twice * (u * u + v * v) * std::abs(value);
            }
            if (begin >= end)
                continue;
            for (int64_t kx = begin; kx < end; ++kx) {
                re_.push_back(values[static_cast<size_t>(kx - first)].real());
                im_.push_back(values[static_cast<size_t>(kx - first)].imag());
            }
            runs_.push_back({begin, ky, end - begin, row * (half + 1) + begin - fold, start});
        }
    }
    curvature_ *= per_index * per_index;
}

View<double> GalaxyGrid::draw(const SersicTable &profile, const WaveForm &form, double x, double y,
                              double flux, GalaxyBuffers &buffers) const {
    const int64_t half = size_ / 2;
    const double per_index = 1 / static_cast<double>(size_ * step_);
    const auto waves = static_cast<size_t>(2 * reach_ + 1);
    if (buffers.phase_x.size() < waves) {
        buffers.phase_x.resize(waves);
        buffers.phase_y.resize(waves);
        buffers.profile.resize(waves);
    }
    const auto samples = static_cast<size_t>(size_ * size_);
    buffers.spectrum.assign(static_cast<size_t>((half + 1) * size_), 0);
    if (buffers.samples.size() < samples)
        buffers.samples.resize(samples);

    const auto middle = static_cast<double>(half * step_);
    fill_phases(reach_, (x + middle) * per_index, 1, buffers.phase_x.data());
    fill_phases(reach_, (y + middle) * per_index, flux * per_index * per_index,
                buffers.phase_y.data());
    const double square = per_index * per_index;
    const SersicTable::Lookup lookup = profile.lookup();
    const double a = form.xx * square, b = form.xy * square, c = form.yy * square;
    for (const Run &run : runs_) {
        // As far as the profile's transform counts: a x^2 + 2 b x y + c y^2 <= largest.
        const auto ky = static_cast<double>(run.ky);
        const double inside = b * b * ky * ky - a * (c * ky * ky - form.largest);
        if (inside < 0)
            continue;
        const double width = std::sqrt(inside) / a, centre = -b * ky / a;
        const auto lowest = static_cast<double>(run.kx);
        const auto highest = static_cast<double>(run.kx + run.count - 1);
        if (centre - width > highest || centre + width < lowest)
            continue;
        const auto first = static_cast<int64_t>(std::max(lowest, std::ceil(centre - width)));
        const auto last = static_cast<int64_t>(std::min(highest, std::floor(centre + width)));
        if (first > last)
            continue;
        const int64_t count = last - first + 1, skipped = first - run.kx;
        fill_profile(lookup, a, 2 * b * ky, c * ky * ky, first, count, buffers.profile.data());
        add_products(buffers.profile.data(), re_.data() + run.first + skipped,
                     im_.data() + run.first + skipped, buffers.phase_x.data() + first + reach_,
                     buffers.phase_y[static_cast<size_t>(run.ky + reach_)], count,
                     buffers.spectrum.data() + run.target + skipped);
    }
    fft_.run(buffers.spectrum.data(), buffers.samples.data());
    return {buffers.samples.data(), size_, size_, 1, size_};
}

} // namespace wfpsf
