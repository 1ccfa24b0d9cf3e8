// SPDX-License-Identifier: GPL-3.0-or-later
#include "moments/pixel_moments.hpp"

#include "moments/compensated_sum.hpp"
#include "moments/weighted_sums.hpp"

#include <cmath>

namespace wfpsf {

namespace {

constexpr int order = 4;
constexpr double full_reach2 = 74; // exp(-37) is below rounding

constexpr double binomial[5][5] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}, {1, 4, 6, 4, 1}};

double power(double x, int n) {
    double product = 1;
    for (int i = 0; i < n; ++i)
        product *= x;
    return product;
}

// Calls body(index, j, k) for the sums in their order.
template <class Body> void for_each_sum(Body &&body) {
    size_t index = 0;
    for (int n = 0; n <= order; ++n)
        for (int k = 0; k <= n; ++k)
            body(index++, n - k, k);
}

} // namespace

template <class T> PixelSums pixel_sums(View<const T> image, const Gaussian &weight) {
    const WeightedSums whitened = weighted_sums(image, weight, full_reach2);
    const double s = weight.s(), l = weight.root_yy(), shear = weight.shear() * l;
    PixelSums sums{};
    // dx = s t + shear v, dy = l v
    for_each_sum([&](size_t index, int j, int k) {
        for (int m = 0; m <= j; ++m)
            sums[index] += binomial[j][m] * power(s, m) * power(shear, j - m) * power(l, k) *
                           whitened.sum[m][j - m + k];
    });
    return sums;
}

template <class T> PixelSums pixel_sums(View<const T> image, double x, double y) {
    std::array<CompensatedSum, 15> sums;
    for (int64_t j = 0; j < image.ny; ++j) {
        const double dy = static_cast<double>(j) - y;
        for (int64_t i = 0; i < image.nx; ++i) {
            const double dx = static_cast<double>(i) - x;
            const auto value = static_cast<double>(image(i, j));
            for_each_sum([&](size_t index, int m, int k) {
                sums[index].add(value * power(dx, m) * power(dy, k));
            });
        }
    }
    PixelSums result{};
    for (size_t i = 0; i < sums.size(); ++i)
        result[i] = sums[i].value();
    return result;
}

MomentSet<HyperDual> moments_of_sums(const std::array<HyperDual, 6> &sums, double x, double y,
                                     Centre centre) {
    const HyperDual dx = sums[1] / sums[0], dy = sums[2] / sums[0];
    MomentSet<HyperDual> m;
    m.flux = sums[0];
    m.x = x;
    m.y = y;
    m.Mxx = sums[3] / sums[0];
    m.Mxy = sums[4] / sums[0];
    m.Myy = sums[5] / sums[0];
    if (centre != Centre::point) {
        m.x = x + dx;
        m.y = y + dy;
    }
    if (centre == Centre::mean) {
        m.Mxx = m.Mxx - dx * dx;
        m.Mxy = m.Mxy - dx * dy;
        m.Myy = m.Myy - dy * dy;
    }
    return m;
}

void influence_image(const std::optional<Gaussian> &weight, double x, double y,
                     const std::array<double, 6> &k, View<double> out) {
    for (int64_t j = 0; j < out.ny; ++j)
        for (int64_t i = 0; i < out.nx; ++i) {
            const double dx = static_cast<double>(i) - x, dy = static_cast<double>(j) - y;
            double w = 1;
            if (weight) {
                const double v = dy / weight->root_yy();
                const double t = (dx - weight->shear() * dy) / weight->s();
                w = std::exp(-(t * t + v * v) / 2);
            }
            out(i, j) = w * (k[0] + k[1] * dx + k[2] * dy + k[3] * dx * dx + k[4] * dx * dy +
                             k[5] * dy * dy);
        }
}

template PixelSums pixel_sums(View<const float>, const Gaussian &);
template PixelSums pixel_sums(View<const double>, const Gaussian &);
template PixelSums pixel_sums(View<const float>, double, double);
template PixelSums pixel_sums(View<const double>, double, double);

} // namespace wfpsf
