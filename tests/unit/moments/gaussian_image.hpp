// SPDX-License-Identifier: GPL-3.0-or-later
// Gaussian images in closed form.
#pragma once

#include "image/view.hpp"
#include "moments/gaussian.hpp"

#include <cmath>
#include <numbers>

namespace wfpsf {

inline Gaussian gaussian_of(double x, double y, double sigma, double e1, double e2) {
    const double half_trace = sigma * sigma / std::sqrt(1 - e1 * e1 - e2 * e2);
    return {x, y, half_trace * (1 + e1), half_trace * e2, half_trace * (1 - e1)};
}

inline double rho2(const Gaussian &g, double x, double y) {
    const double dx = x - g.x, dy = y - g.y;
    return (g.Myy * dx * dx - 2 * g.Mxy * dx * dy + g.Mxx * dy * dy) / g.det();
}

// flux/(2 pi sqrt(det M)) exp(-rho^2/2) at the pixel centres, added to the image.
template <class T> void add_gaussian(View<T> image, const Gaussian &g, double flux) {
    const double peak = flux / (2 * std::numbers::pi * std::sqrt(g.det()));
    for (int64_t y = 0; y < image.ny; ++y)
        for (int64_t x = 0; x < image.nx; ++x)
            image(x, y) += static_cast<T>(
                peak * std::exp(-rho2(g, static_cast<double>(x), static_cast<double>(y)) / 2));
}

inline Plane<double> gaussian_image(int64_t nx, int64_t ny, const Gaussian &g, double flux = 1) {
    Plane<double> image(nx, ny);
    add_gaussian(image.view(), g, flux);
    return image;
}

inline View<const double> view_of(const Plane<double> &plane) {
    return plane.view();
}

} // namespace wfpsf
