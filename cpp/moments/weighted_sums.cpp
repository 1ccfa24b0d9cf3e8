// SPDX-License-Identifier: GPL-3.0-or-later
#include "moments/weighted_sums.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace wfpsf {

namespace {

// Two doubles, the vector width of baseline x86-64.
typedef double Pair __attribute__((vector_size(16)));

// The Gaussian along a row is w_(n+1) = w_n r_n, r_(n+1) = r_n q: two multiplications a pixel.
// Rounding grows with the square of the number of steps, so the recurrence starts afresh after a
// block: 64 steps of two pixels keep it below 3e-13 in the worst case.
constexpr int64_t block = 128;

// Below this width in pixels r could overflow, and rows are too short to gain.
constexpr double narrowest_recurrence = 1;

struct RowWeight {
    explicit RowWeight(double width)
        : h(1 / width), half(std::exp(-h * h / 2)), two(std::exp(-2 * h * h)), q(two * two) {}
    double h;    // whitened length of a pixel
    double half; // exp(-h^2/2)
    double two;  // exp(-2 h^2)
    double q;    // exp(-4 h^2)
};

// Adds sum of I exp(-(t^2 + v2)/2) t^k, k = 0..4, over n pixels, the first of them at t.
// `stride` is a type that holds 1 at compile time, or a number.
template <class T, class Stride>
void add_block(const T *pixel, Stride stride, int64_t n, double t0, double v2, const RowWeight &row,
               Pair total[5]) {
    const double first = std::exp(-(t0 * t0 + v2) / 2), g = std::exp(-row.h * t0);
    Pair t = {t0, t0 + row.h};
    Pair w = {first, first * g * row.half};
    Pair r = {g * g * row.two, g * g * row.q};
    const Pair step = {2 * row.h, 2 * row.h}, q = {row.q, row.q};
    Pair s0 = total[0], s1 = total[1], s2 = total[2], s3 = total[3], s4 = total[4];
    const auto add = [&](Pair value) {
        Pair f = value * w;
        s0 += f;
        f *= t;
        s1 += f;
        f *= t;
        s2 += f;
        f *= t;
        s3 += f;
        f *= t;
        s4 += f;
    };
    int64_t i = 0;
    for (; i + 1 < n; i += 2) {
        add(Pair{static_cast<double>(pixel[i * stride]),
                 static_cast<double>(pixel[(i + 1) * stride])});
        t += step;
        w *= r;
        r *= q;
    }
    if (i < n)
        add(Pair{static_cast<double>(pixel[i * stride]), 0});
    total[0] = s0;
    total[1] = s1;
    total[2] = s2;
    total[3] = s3;
    total[4] = s4;
}

template <class T>
void add_row(const T *pixel, int64_t stride, int64_t n, double t0, double v2, const RowWeight &row,
             double out[5]) {
    Pair total[5] = {};
    if (row.h > 1 / narrowest_recurrence) {
        for (int64_t i = 0; i < n; ++i) {
            const double t = t0 + static_cast<double>(i) * row.h;
            Pair f = {static_cast<double>(pixel[i * stride]) * std::exp(-(t * t + v2) / 2), 0};
            for (int k = 0; k < 5; ++k) {
                total[k] += f;
                f *= t;
            }
        }
    } else {
        for (int64_t i = 0; i < n; i += block) {
            const int64_t length = std::min(block, n - i);
            const double t = t0 + static_cast<double>(i) * row.h;
            if (stride == 1)
                add_block(pixel + i, std::integral_constant<int64_t, 1>{}, length, t, v2, row,
                          total);
            else
                add_block(pixel + i * stride, stride, length, t, v2, row, total);
        }
    }
    for (int k = 0; k < 5; ++k)
        out[k] = total[k][0] + total[k][1];
}

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
                           int64_t stride) {
    if (stride > 1) {
        const auto step = static_cast<double>(stride);
        const View<const T> thinned{image.data, (image.nx + stride - 1) / stride,
                                    (image.ny + stride - 1) / stride, image.stride_x * stride,
                                    image.stride_y * stride};
        const Gaussian scaled{weight.x / step, weight.y / step, weight.Mxx / (step * step),
                              weight.Mxy / (step * step), weight.Myy / (step * step)};
        WeightedSums sums = weighted_sums(thinned, scaled, reach2);
        for (auto &row : sums.sum)
            for (double &value : row)
                value *= step * step;
        return sums;
    }

    WeightedSums sums;
    const RowWeight row(weight.s());
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
        double s[5];
        add_row(pixel, image.stride_x, n, t0, v * v, row, s);
        double power = 1;
        for (int k = 0; k < 5; ++k) {
            for (int j = 0; j + k < 5; ++j)
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

template WeightedSums weighted_sums(View<const float>, const Gaussian &, double, int64_t);
template WeightedSums weighted_sums(View<const double>, const Gaussian &, double, int64_t);

} // namespace wfpsf
