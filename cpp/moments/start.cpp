// SPDX-License-Identifier: GPL-3.0-or-later
#include "moments/start.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace wfpsf {

namespace {

// out = in filtered by (1, 4, 6, 4, 1)/16, of variance 1, along a line; zeros beyond its ends.
void binomial_line(const double *in, double *out, int64_t n, int64_t stride) {
    const auto at = [&](int64_t i) { return i < 0 || i >= n ? 0.0 : in[i * stride]; };
    for (int64_t i = 0; i < n; ++i)
        out[i] = (at(i - 2) + at(i + 2) + 4 * (at(i - 1) + at(i + 1)) + 6 * at(i)) / 16;
}

void smooth(Plane<double> &plane) {
    const int64_t nx = plane.nx(), ny = plane.ny();
    std::vector<double> line(static_cast<size_t>(nx));
    for (int64_t y = 0; y < ny; ++y) {
        binomial_line(&plane(0, y), line.data(), nx, 1);
        std::copy(line.begin(), line.end(), &plane(0, y));
    }
    // All columns at once, row by row, with the two rows above kept as they were.
    const std::vector<double> zero(static_cast<size_t>(nx), 0.0);
    std::vector<double> above2 = zero, above1 = zero;
    for (int64_t y = 0; y < ny; ++y) {
        double *row = &plane(0, y);
        const double *below1 = y + 1 < ny ? &plane(0, y + 1) : zero.data();
        const double *below2 = y + 2 < ny ? &plane(0, y + 2) : zero.data();
        for (size_t x = 0; x < line.size(); ++x) {
            const double here = row[x];
            row[x] = (above2[x] + below2[x] + 4 * (above1[x] + below1[x]) + 6 * here) / 16;
            above2[x] = above1[x];
            above1[x] = here;
        }
    }
}

Plane<double> every_second(const Plane<double> &in) {
    Plane<double> out((in.nx() + 1) / 2, (in.ny() + 1) / 2);
    for (int64_t y = 0; y < out.ny(); ++y)
        for (int64_t x = 0; x < out.nx(); ++x)
            out(x, y) = in(2 * x, 2 * y);
    return out;
}

// The finite pixels, scaled so that sums of them cannot overflow.
template <class T> Plane<double> finite_copy(View<const T> image) {
    Plane<double> copy(image.nx, image.ny);
    double largest = 0;
    for (int64_t y = 0; y < image.ny; ++y)
        for (int64_t x = 0; x < image.nx; ++x) {
            const double value = static_cast<double>(image(x, y));
            copy(x, y) = std::isfinite(value) ? value : 0;
            largest = std::max(largest, std::abs(copy(x, y)));
        }
    if (largest > 0)
        for (int64_t y = 0; y < image.ny; ++y)
            for (int64_t x = 0; x < image.nx; ++x)
                copy(x, y) /= largest;
    return copy;
}

} // namespace

template <class T> std::optional<Gaussian> scale_space_start(View<const T> image) {
    std::optional<Gaussian> best;
    if (image.empty())
        return best;
    double largest = 0;
    double variance = 1; // of the smoothing so far, pixels^2
    int64_t step = 1;    // pixels from sample to sample
    Plane<double> level = finite_copy(image);
    smooth(level);
    while (true) {
        smooth(level);
        variance += static_cast<double>(step * step);
        const double sigma = std::sqrt(variance);
        for (int64_t y = 0; y < level.ny(); ++y)
            for (int64_t x = 0; x < level.nx(); ++x)
                if (level(x, y) * sigma > largest) {
                    largest = level(x, y) * sigma;
                    best = Gaussian{static_cast<double>(x * step), static_cast<double>(y * step),
                                    variance, 0, variance};
                }
        if (std::max(level.nx(), level.ny()) < 8)
            return best;
        level = every_second(level);
        step *= 2;
    }
}

template std::optional<Gaussian> scale_space_start(View<const float>);
template std::optional<Gaussian> scale_space_start(View<const double>);

} // namespace wfpsf
