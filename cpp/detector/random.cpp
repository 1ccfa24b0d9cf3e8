// SPDX-License-Identifier: GPL-3.0-or-later
// All numbers are made in groups of a fixed size: a pixel goes through the same instructions
// whatever its neighbours are, so that its bits depend on its own place alone.
#include "detector/random.hpp"

#include "numerics/dispatch.hpp"
#include "numerics/elementary.hpp"
#include "numerics/phasor.hpp"

#include <Random123/philox.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

namespace wfpsf {

namespace {

constexpr size_t lanes = 16;
constexpr size_t chunk = 256; // pixels at a time: what is kept of them stays in the nearest cache
static_assert(chunk % lanes == 0);

template <class T> using Chunk = std::array<T, chunk>;

constexpr size_t whole_groups(size_t count) {
    return (count + lanes - 1) / lanes * lanes;
}

// What the pixels of a row have in common.
struct Row {
    uint32_t key[2];
    uint32_t y, stream, draw;

    Row(const RandomSource &source, int64_t row)
        : key{static_cast<uint32_t>(source.seed), static_cast<uint32_t>(source.seed >> 32)},
          y(static_cast<uint32_t>(source.y0 + row)), stream(source.stream),
          draw(source.draw << 24) {}
};

// In (0, 1): 52 bits and a half.
[[gnu::always_inline]] inline double uniform(uint32_t high, uint32_t low) {
    const uint64_t bits = (uint64_t{high} << 32 | low) >> 12;
    return (std::bit_cast<double>(bits | 0x3ff0000000000000) - 1) + 0x1p-53;
}

// The two numbers number 2 `block` and 2 `block` + 1 of each of a group of pixels.
[[gnu::always_inline]] inline void two_uniforms(const Row &row, const uint32_t *x, uint32_t block,
                                                double *first, double *second) {
    const r123::Philox4x32::key_type key{{row.key[0], row.key[1]}};
    for (size_t i = 0; i < lanes; ++i) {
        const r123::Philox4x32::ctr_type words =
            philox4x32_R(10, {{x[i], row.y, row.stream, row.draw + block}}, key);
        first[i] = uniform(words.v[2], words.v[3]);
        second[i] = uniform(words.v[0], words.v[1]);
    }
}

WFPSF_VECTORISED void box_muller(const Row &row, const uint32_t *x, size_t groups, double *even,
                                 double *odd) {
    for (size_t g = 0; g < groups; ++g, x += lanes, even += lanes, odd += lanes) {
        double u[lanes], v[lanes];
        two_uniforms(row, x, 0, u, v);
        for (size_t i = 0; i < lanes; ++i) {
            double cosine, sine;
            phasor(v[i], cosine, sine);
            const double radius = std::sqrt(-2 * branchless_log(u[i]));
            even[i] = radius * cosine;
            odd[i] = radius * sine;
        }
    }
}

// Pixels that are not done yet, and where they came from.
struct Pending {
    size_t count = 0;
    Chunk<uint32_t> x;
    Chunk<double> mean;
    Chunk<uint32_t> index;

    void add(uint32_t x_, double mean_, uint32_t index_) {
        x[count] = x_;
        mean[count] = mean_;
        index[count] = index_;
        ++count;
    }

    // `n` pixels in a row.
    void set(uint32_t first_x, const double *means, uint32_t n) {
        count = n;
        for (uint32_t i = 0; i < n; ++i) {
            x[i] = first_x + i;
            mean[i] = means[i];
            index[i] = i;
        }
    }

    // Fills the last group with what is harmless.
    void pad() {
        for (size_t i = count; i < whole_groups(count); ++i) {
            x[i] = 0;
            mean[i] = mean[0];
        }
    }
};

constexpr double inverted_below = 24;

constexpr size_t steps_at_once = 4;

// 1 / k. Beyond the last are less than 1e-26 of the numbers: only rounding leads there.
constexpr auto reciprocals = [] {
    std::array<double, 100> r{};
    static_assert(r.size() % steps_at_once == 0);
    for (size_t k = 0; k < r.size(); ++k)
        r[k] = 1 / static_cast<double>(k + 1);
    return r;
}();

// The first k whose cumulative probability reaches a uniform number, for each of one group.
WFPSF_VECTORISED void poisson_by_inversion(const Row &row, const uint32_t *x, const double *mean,
                                           double *drawn) {
    double u[lanes], unused[lanes], probability[lanes], cumulative[lanes];
    two_uniforms(row, x, 0, u, unused);
    for (size_t i = 0; i < lanes; ++i) {
        probability[i] = cumulative[i] = branchless_exp(-mean[i]);
        drawn[i] = 0;
    }
    // A few steps at a time: those that are not needed change nothing.
    for (size_t k = 0; k < reciprocals.size(); k += steps_at_once) {
        uint64_t any_above = 0;
        for (size_t step = 0; step < steps_at_once; ++step)
            for (size_t i = 0; i < lanes; ++i) {
                const bool above = u[i] > cumulative[i];
                drawn[i] += above ? 1.0 : 0.0;
                any_above |= above ? 1 : 0;
                probability[i] *= mean[i] * reciprocals[k + step];
                cumulative[i] += probability[i];
            }
        if (any_above == 0)
            return;
    }
}

// log(k!) - (k log k - k + log(2 pi k) / 2), k > 0: exact sums for small k, Stirling's series
// above.
constexpr double stirling_from = 16;

const std::array<double, 16> small_stirling_errors = [] {
    std::array<double, 16> errors{};
    double log_factorial = 0;
    for (size_t i = 1; i < errors.size(); ++i) {
        const auto k = static_cast<double>(i);
        log_factorial += std::log(k);
        errors[i] = log_factorial - (k * std::log(k) - k + std::log(2 * std::numbers::pi * k) / 2);
    }
    return errors;
}();

[[gnu::always_inline]] inline double stirling_series(double k) {
    const double inverse = 1 / k, square = inverse * inverse;
    return (1.0 / 12 - (1.0 / 360 - (1.0 / 1260 - square / 1680) * square) * square) * inverse;
}

double stirling_error(double k) {
    return k < stirling_from ? small_stirling_errors[static_cast<size_t>(k)] : stirling_series(k);
}

// log of exp(-mean) mean^k / k!, without the cancellation that large means have in it.
double log_poisson(double k, double mean) {
    if (k == 0)
        return -mean;
    const double off = (mean - k) / k; // k (log(mean / k) - off) is small near the peak
    return k * (std::log1p(off) - off) - stirling_error(k) - std::log(2 * std::numbers::pi * k) / 2;
}

// Hoermann, "The transformed rejection method for generating Poisson random variables", 1993.
struct Transformed {
    double b, a;
    [[gnu::always_inline]] explicit Transformed(double mean)
        : b(0.931 + 2.53 * std::sqrt(mean)), a(-0.059 + 0.02483 * b) {}
    double inverse_alpha() const { return 1.1239 + 1.1328 / (b - 3.4); }
};

// What pixels were offered: k, whether it needs a closer look, and what that takes.
struct Offers {
    Chunk<double> k, us, v;
    Chunk<uint64_t> unsure; // 0 or 1
};

WFPSF_VECTORISED void offer(const Row &row, const uint32_t *x, const double *mean, size_t groups,
                            uint32_t attempt, Offers &offers) {
    double u[lanes], v[lanes];
    for (size_t g = 0; g < groups; ++g) {
        two_uniforms(row, x + g * lanes, attempt, u, v);
        for (size_t i = 0; i < lanes; ++i) {
            const size_t at = g * lanes + i;
            const Transformed t(mean[at]);
            const double centred = u[i] - 0.5, us = 0.5 - std::fabs(centred);
            offers.k[at] = std::floor((2 * t.a / us + t.b) * centred + mean[at] + 0.43);
            const double v_r = 0.9277 - 3.6224 / (t.b - 2);
            offers.unsure[at] = (us >= 0.07) & (v[i] <= v_r) ? 0 : 1;
            offers.us[at] = us;
            offers.v[at] = v[i];
        }
    }
}

// The log of the ratio that decides, > 0 to accept: NaN where the series are not good enough.
WFPSF_VECTORISED void decide(const double *mean, const double *k, const double *us, const double *v,
                             size_t groups, double *excess) {
    for (size_t at = 0; at < groups * lanes; ++at) { // groups: no rest that goes another way
        const Transformed t(mean[at]);
        const double off = (mean[at] - k[at]) / k[at], s = off / (2 + off), square = s * s;
        // log(1 + off) - off = 2 atanh(s) - off, its leading terms taken together.
        double tail = elementary_detail::atanh_series.back();
        for (size_t j = elementary_detail::atanh_series.size() - 1; j-- > 1;)
            tail = tail * square + elementary_detail::atanh_series[j];
        const double bend = s * (2 * square * tail - off);
        const double squeezed = v[at] * t.inverse_alpha() / (t.a / (us[at] * us[at]) + t.b);
        // Two logs in one: log(squeezed) + log(2 pi k) / 2.
        const double log_both =
            branchless_log(squeezed * squeezed * (2 * std::numbers::pi) * k[at]) / 2;
        const double found = k[at] * bend - stirling_series(k[at]) - log_both;
        const bool good = (k[at] >= stirling_from) & (square < 0.17 * 0.17);
        excess[at] = good ? found : std::numeric_limits<double>::quiet_NaN();
    }
}

bool accepts(double mean, double k, double us, double v, double excess) {
    if (k < 0 || (us < 0.013 && v > us))
        return false;
    if (!std::isnan(excess))
        return excess >= 0;
    const Transformed t(mean);
    return std::log(v * t.inverse_alpha() / (t.a / (us * us) + t.b)) <= log_poisson(k, mean);
}

// All pending pixels make their attempts together; most are done at the first.
void poisson_by_rejection(const Row &row, Pending &pending, double *drawn) {
    Offers offers;
    Chunk<double> mean, k, us, v, excess;
    Chunk<uint32_t> from;
    for (uint32_t attempt = 0; pending.count > 0; ++attempt) {
        pending.pad();
        offer(row, pending.x.data(), pending.mean.data(), whole_groups(pending.count) / lanes,
              attempt, offers);
        size_t unsure = 0;
        for (uint32_t i = 0; i < pending.count; ++i) {
            drawn[pending.index[i]] = offers.k[i];
            from[unsure] = i;
            unsure += static_cast<size_t>(offers.unsure[i]);
        }
        const size_t whole = whole_groups(unsure);
        std::fill_n(from.begin() + static_cast<std::ptrdiff_t>(unsure), whole - unsure, 0);
        for (size_t i = 0; i < whole; ++i) {
            mean[i] = pending.mean[from[i]];
            k[i] = offers.k[from[i]];
            us[i] = offers.us[from[i]];
            v[i] = offers.v[from[i]];
        }
        decide(mean.data(), k.data(), us.data(), v.data(), whole / lanes, excess.data());
        pending.count = 0; // what is kept moves to the front: from[i] >= pending.count
        for (size_t i = 0; i < unsure; ++i)
            if (!accepts(mean[i], k[i], us[i], v[i], excess[i]))
                pending.add(pending.x[from[i]], mean[i], pending.index[from[i]]);
    }
}

// How many means are of which sort. Neighbours tend to be of one.
struct Sorts {
    uint64_t few, many;
};

WFPSF_VECTORISED Sorts sorts_of(const double *means, size_t count) {
    constexpr double most = std::numeric_limits<double>::max();
    Sorts sorts{0, 0};
    for (size_t i = 0; i < count; ++i) {
        sorts.few += (means[i] > 0) & (means[i] < inverted_below) ? 1 : 0;
        sorts.many += (means[i] >= inverted_below) & (means[i] <= most) ? 1 : 0;
    }
    return sorts;
}

} // namespace

void fill_normal(const RandomSource &source, int64_t x, int64_t y, int64_t count, double *normal) {
    const int64_t begin = source.x0 + x, end = begin + count;
    const Row row(source, y);
    Chunk<uint32_t> places;
    Chunk<double> even, odd;
    for (int64_t pair = begin - (begin & 1); pair < end; pair += 2 * std::ssize(places)) {
        const int64_t pairs = std::min(std::ssize(places), (end - pair + 1) / 2);
        const size_t whole = whole_groups(static_cast<size_t>(pairs));
        for (size_t i = 0; i < whole; ++i)
            places[i] = static_cast<uint32_t>(pair + 2 * static_cast<int64_t>(i));
        box_muller(row, places.data(), whole / lanes, even.data(), odd.data());
        for (int64_t i = 0; i < pairs; ++i) {
            const int64_t at = pair + 2 * i - begin;
            if (at >= 0)
                normal[at] = even[static_cast<size_t>(i)];
            if (at + 1 < count)
                normal[at + 1] = odd[static_cast<size_t>(i)];
        }
    }
}

void draw_poisson(const RandomSource &source, int64_t x, int64_t y, int64_t count, double *means) {
    const Row row(source, y);
    Pending few, many;
    for (int64_t first = 0; first < count; first += std::ssize(few.x)) {
        double *drawn = means + first;
        const auto n = static_cast<uint32_t>(std::min(std::ssize(few.x), count - first));
        few.count = many.count = 0;
        const auto first_x = static_cast<uint32_t>(source.x0 + x + first);
        const Sorts sorts = sorts_of(drawn, n);
        if (sorts.few == n)
            few.set(first_x, drawn, n);
        else if (sorts.many == n)
            many.set(first_x, drawn, n);
        else
            for (uint32_t i = 0; i < n; ++i)
                if (drawn[i] > 0 && std::isfinite(drawn[i]))
                    (drawn[i] < inverted_below ? few : many).add(first_x + i, drawn[i], i);
        few.pad();
        for (size_t begin = 0; begin < few.count; begin += lanes) {
            double numbers[lanes];
            poisson_by_inversion(row, few.x.data() + begin, few.mean.data() + begin, numbers);
            for (size_t i = 0; i < std::min(lanes, few.count - begin); ++i)
                drawn[few.index[begin + i]] = numbers[i];
        }
        poisson_by_rejection(row, many, drawn);
    }
}

} // namespace wfpsf
