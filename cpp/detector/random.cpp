// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/random.hpp"

#include <Random123/philox.h>
#include <array>
#include <cmath>
#include <numbers>

namespace wfpsf {

namespace {

// The uniform numbers of one place, in (0, 1): 52 bits and a half.
class Uniform {
  public:
    Uniform(const RandomSource &source, int64_t x, int64_t y)
        : key_{{static_cast<uint32_t>(source.seed), static_cast<uint32_t>(source.seed >> 32)}},
          counter_{{static_cast<uint32_t>(x), static_cast<uint32_t>(y), source.stream,
                    source.draw << 24}} {}

    double operator()() {
        if (left_ == 0) {
            block_ = philox_(counter_, key_);
            ++counter_[3];
            left_ = 2;
        }
        --left_;
        const auto high = uint64_t{block_[2 * left_]}, low = uint64_t{block_[2 * left_ + 1]};
        return (static_cast<double>((high << 32 | low) >> 12) + 0.5) * 0x1p-52;
    }

  private:
    r123::Philox4x32 philox_;
    r123::Philox4x32::key_type key_;
    r123::Philox4x32::ctr_type counter_, block_{};
    size_t left_ = 0;
};

double poisson_by_products(double mean, Uniform &uniform) {
    const double least = std::exp(-mean);
    double product = uniform(), k = 0;
    while (product > least) {
        product *= uniform();
        ++k;
    }
    return k;
}

// log(k!) - (k log k - k + log(2 pi k) / 2), k > 0: exact sums for small k, Stirling's series
// above.
double stirling_error(double k) {
    if (k < 16) {
        double log_factorial = 0;
        for (int i = 2; i <= static_cast<int>(k); ++i)
            log_factorial += std::log(static_cast<double>(i));
        return log_factorial - (k * std::log(k) - k + std::log(2 * std::numbers::pi * k) / 2);
    }
    const double square = k * k;
    return (1.0 / 12 - (1.0 / 360 - (1.0 / 1260 - 1.0 / (1680 * square)) / square) / square) / k;
}

// log of exp(-mean) mean^k / k!, without the cancellation that large means have in it.
double log_poisson(double k, double mean) {
    if (k == 0)
        return -mean;
    const double off = (mean - k) / k; // k (log(mean / k) - off) is small near the peak
    return k * (std::log1p(off) - off) - stirling_error(k) - std::log(2 * std::numbers::pi * k) / 2;
}

// Hoermann, "The transformed rejection method for generating Poisson random variables", 1993.
double poisson_by_rejection(double mean, Uniform &uniform) {
    const double b = 0.931 + 2.53 * std::sqrt(mean), a = -0.059 + 0.02483 * b;
    const double inverse_alpha = 1.1239 + 1.1328 / (b - 3.4), v_r = 0.9277 - 3.6224 / (b - 2);
    while (true) {
        const double u = uniform() - 0.5, v = uniform(), us = 0.5 - std::fabs(u);
        const double k = std::floor((2 * a / us + b) * u + mean + 0.43);
        if (us >= 0.07 && v <= v_r)
            return k;
        if (k < 0 || (us < 0.013 && v > us))
            continue;
        if (std::log(v * inverse_alpha / (a / (us * us) + b)) <= log_poisson(k, mean))
            return k;
    }
}

} // namespace

void fill_normal(const RandomSource &source, int64_t x, int64_t y, int64_t count, double *normal) {
    const int64_t begin = source.x0 + x, end = begin + count;
    for (int64_t pair = begin - (begin & 1); pair < end; pair += 2) {
        Uniform uniform(source, pair, source.y0 + y);
        const double radius = std::sqrt(-2 * std::log(uniform()));
        const double angle = 2 * std::numbers::pi * uniform();
        if (pair >= begin)
            normal[pair - begin] = radius * std::cos(angle);
        if (pair + 1 < end)
            normal[pair + 1 - begin] = radius * std::sin(angle);
    }
}

void draw_poisson(const RandomSource &source, int64_t x, int64_t y, int64_t count, double *means) {
    for (int64_t i = 0; i < count; ++i) {
        const double mean = means[i];
        if (!(mean > 0 && std::isfinite(mean)))
            continue;
        Uniform uniform(source, source.x0 + x + i, source.y0 + y);
        means[i] =
            mean < 10 ? poisson_by_products(mean, uniform) : poisson_by_rejection(mean, uniform);
    }
}

} // namespace wfpsf
