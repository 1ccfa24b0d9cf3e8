// SPDX-License-Identifier: GPL-3.0-or-later
#include "moments/weighted_sums.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace wfpsf {

namespace {

// The Gaussian along a row is w_(n+1) = w_n r_n, r_(n+1) = r_n q: two multiplications for as many
// pixels as a vector has lanes. Rounding grows with the square of the number of steps, so the
// recurrence starts afresh after a block: 64 steps keep it below 3e-13 in the worst case.
constexpr int64_t steps_per_block = 64;

// Below this width in pixels r could overflow, and rows are too short to gain.
constexpr double narrowest_recurrence = 1;

template <int lanes> struct RowWeight {
    explicit RowWeight(double width) : h(1 / width), q(std::exp(-h * h * lanes * lanes)) {
        for (int i = 0; i < lanes; ++i) {
            w[i] = std::exp(-h * h * i * i / 2);
            r[i] = std::exp(-h * h * lanes * (i + lanes / 2.0));
        }
    }
    double h;        // whitened length of a pixel
    double q;        // exp(-lanes^2 h^2)
    double w[lanes]; // exp(-(i h)^2/2)
    double r[lanes]; // the ratio of w from step to step if the first pixel stands at t = 0
};

template <int lanes> struct Vector { typedef double type __attribute__((vector_size(8 * lanes))); };

// Adds sum of I exp(-(t^2 + v2)/2) t^k, k = 0..order, over n pixels, the first of them at t0.
// `stride` is a type that holds 1 at compile time, or a number.
template <int lanes, int order, class T, class Stride>
[[gnu::always_inline]] inline void add_block(const T *pixel, Stride stride, int64_t n, double t0,
                                             double v2, const RowWeight<lanes> &row,
                                             typename Vector<lanes>::type total[order + 1]) {
    using Lanes = typename Vector<lanes>::type;
    const double g = std::exp(-row.h * t0);
    double first = std::exp(-(t0 * t0 + v2) / 2), ratio = 1;
    for (int i = 0; i < lanes; ++i)
        ratio *= g;
    Lanes t, w, r, sum[order + 1];
    for (int i = 0; i < lanes; ++i) {
        t[i] = t0 + i * row.h;
        w[i] = first * row.w[i];
        r[i] = ratio * row.r[i];
        first *= g;
    }
    for (int k = 0; k <= order; ++k)
        sum[k] = total[k];
    int64_t i = 0;
    for (; i + lanes <= n; i += lanes) {
        Lanes f;
        for (int k = 0; k < lanes; ++k)
            f[k] = static_cast<double>(pixel[(i + k) * stride]);
        f *= w;
        sum[0] += f;
#pragma GCC unroll 8
        for (int k = 1; k <= order; ++k) {
            f *= t;
            sum[k] += f;
        }
        t += lanes * row.h;
        w *= r;
        r *= row.q;
    }
    if (i < n) {
        Lanes f = {};
        for (int k = 0; i + k < n; ++k)
            f[k] = static_cast<double>(pixel[(i + k) * stride]);
        f *= w;
        for (int k = 0; k <= order; ++k) {
            sum[k] += f;
            f *= t;
        }
    }
    for (int k = 0; k <= order; ++k)
        total[k] = sum[k];
}

template <int lanes, int order, class T>
[[gnu::always_inline]] inline void add_row(const T *pixel, int64_t stride, int64_t n, double t0,
                                           double v2, const RowWeight<lanes> &row,
                                           double out[order + 1]) {
    if (row.h > 1 / narrowest_recurrence) {
        for (int k = 0; k <= order; ++k)
            out[k] = 0;
        for (int64_t i = 0; i < n; ++i) {
            const double t = t0 + static_cast<double>(i) * row.h;
            double f = static_cast<double>(pixel[i * stride]) * std::exp(-(t * t + v2) / 2);
            for (int k = 0; k <= order; ++k) {
                out[k] += f;
                f *= t;
            }
        }
        return;
    }
    typename Vector<lanes>::type total[order + 1] = {};
    constexpr int64_t block = steps_per_block * lanes;
    for (int64_t i = 0; i < n; i += block) {
        const int64_t length = std::min(block, n - i);
        const double t = t0 + static_cast<double>(i) * row.h;
        if (stride == 1)
            add_block<lanes, order>(pixel + i, std::integral_constant<int64_t, 1>{}, length, t, v2,
                                    row, total);
        else
            add_block<lanes, order>(pixel + i * stride, stride, length, t, v2, row, total);
    }
    for (int k = 0; k <= order; ++k) {
        out[k] = 0;
        for (int i = 0; i < lanes; ++i)
            out[k] += total[k][i];
    }
}

template <int lanes, int order, class T>
[[gnu::always_inline]] inline WeightedSums sums_of(View<const T> image, const Gaussian &weight,
                                                   double reach2) {
    WeightedSums sums;
    const RowWeight<lanes> row(weight.s());
    const double shear = weight.shear(), inverse_root = 1 / weight.root_yy();
    const Span rows = rows_within(weight, reach2, image.ny);
    double rim = 0;
    int64_t rim_pixels = 0;
    for (int64_t y = rows.first; y <= rows.last; ++y) {
        const Span columns = columns_within(weight, reach2, image.nx, y);
        const int64_t n = columns.last - columns.first + 1;
        if (n <= 0)
            continue;
        const double dy = static_cast<double>(y) - weight.y, v = dy * inverse_root;
        const double t0 = (static_cast<double>(columns.first) - weight.x - shear * dy) * row.h;
        const T *pixel = image.row(y) + columns.first * image.stride_x;
        double s[order + 1];
        add_row<lanes, order>(pixel, image.stride_x, n, t0, v * v, row, s);
        double power = 1;
        for (int k = 0; k <= order; ++k) {
            for (int j = 0; j + k <= order; ++j)
                sums.sum[j][k] += s[j] * power;
            power *= v;
        }
        sums.pixels += n;
        if (columns.first > 0) {
            rim += std::abs(static_cast<double>(pixel[0]));
            ++rim_pixels;
        }
        if (columns.last < image.nx - 1) {
            rim += std::abs(static_cast<double>(pixel[(n - 1) * image.stride_x]));
            ++rim_pixels;
        }
    }
    if (rim_pixels > 0)
        sums.rim = rim / static_cast<double>(rim_pixels);
    return sums;
}

// A vector wider than the machine's is slow, so the width is chosen together with the instructions.
#if defined(__x86_64__) && defined(__GNUC__)
template <int order, class T>
__attribute__((target("avx2,fma"))) WeightedSums sums_avx2(View<const T> image,
                                                           const Gaussian &weight, double reach2) {
    return sums_of<4, order>(image, weight, reach2);
}
bool has_avx2() {
    static const bool has = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    return has;
}
template <int order, class T>
WeightedSums sums_on_this_machine(View<const T> image, const Gaussian &weight, double reach2) {
    return has_avx2() ? sums_avx2<order>(image, weight, reach2)
                      : sums_of<2, order>(image, weight, reach2);
}
#else
template <int order, class T>
WeightedSums sums_on_this_machine(View<const T> image, const Gaussian &weight, double reach2) {
    return sums_of<2, order>(image, weight, reach2);
}
#endif

Span span_around(double centre, double half_length, int64_t n) {
    const double low = std::max(0.0, std::ceil(centre - half_length));
    const double high = std::min(static_cast<double>(n - 1), std::floor(centre + half_length));
    if (!(low <= high))
        return {};
    return {static_cast<int64_t>(low), static_cast<int64_t>(high)};
}

} // namespace

Span rows_within(const Gaussian &weight, double reach2, int64_t ny) {
    return span_around(weight.y, std::sqrt(reach2) * weight.root_yy(), ny);
}

Span columns_within(const Gaussian &weight, double reach2, int64_t nx, int64_t y) {
    const double dy = static_cast<double>(y) - weight.y;
    const double v = dy / weight.root_yy();
    const double half_length = std::sqrt(std::max(0.0, reach2 - v * v)) * weight.s();
    return span_around(weight.x + weight.shear() * dy, half_length, nx);
}

template <class T>
WeightedSums weighted_sums(View<const T> image, const Gaussian &weight, double reach2,
                           int64_t stride, int order) {
    if (stride > 1) {
        const auto step = static_cast<double>(stride);
        const View<const T> thinned{image.data, (image.nx + stride - 1) / stride,
                                    (image.ny + stride - 1) / stride, image.stride_x * stride,
                                    image.stride_y * stride};
        const Gaussian scaled{weight.x / step, weight.y / step, weight.Mxx / (step * step),
                              weight.Mxy / (step * step), weight.Myy / (step * step)};
        WeightedSums sums = weighted_sums(thinned, scaled, reach2, 1, order);
        for (auto &row : sums.sum)
            for (double &value : row)
                value *= step * step;
        return sums;
    }
    return order <= 2   ? sums_on_this_machine<2>(image, weight, reach2)
           : order <= 4 ? sums_on_this_machine<4>(image, weight, reach2)
           : order <= 6 ? sums_on_this_machine<6>(image, weight, reach2)
                        : sums_on_this_machine<8>(image, weight, reach2);
}

template <class T>
WeightedSums squared_weight_sums(View<const T> count, const Gaussian &weight, double reach2,
                                 int64_t stride, int order) {
    const Gaussian narrow{weight.x, weight.y, weight.Mxx / 2, weight.Mxy / 2, weight.Myy / 2};
    WeightedSums sums = weighted_sums(count, narrow, 2 * reach2, stride, order);
    for (int j = 0; j <= order; ++j)
        for (int k = 0; j + k <= order; ++k)
            sums.sum[j][k] *= std::pow(0.5, (j + k) / 2.0);
    return sums;
}

template WeightedSums weighted_sums(View<const float>, const Gaussian &, double, int64_t, int);
template WeightedSums weighted_sums(View<const double>, const Gaussian &, double, int64_t, int);
template WeightedSums squared_weight_sums(View<const float>, const Gaussian &, double, int64_t,
                                          int);
template WeightedSums squared_weight_sums(View<const double>, const Gaussian &, double, int64_t,
                                          int);

} // namespace wfpsf
