// SPDX-License-Identifier: GPL-3.0-or-later
#include "moments/unweighted.hpp"

#include "error/error.hpp"
#include "moments/compensated_sum.hpp"

#include <cmath>

namespace wfpsf {

namespace {

double checked_flux(double flux) {
    if (!std::isfinite(flux))
        fail(WFPSF_ERROR_NOT_FINITE, "flux = %g: every pixel must be finite", flux);
    if (flux == 0)
        fail(WFPSF_ERROR_MOMENTS_FLUX, "flux = 0: moments need a flux that is not zero");
    return flux;
}

} // namespace

double UnweightedMoments::radius_det() const {
    return std::pow(Mxx * Myy - Mxy * Mxy, 0.25);
}
double UnweightedMoments::radius_trace() const {
    return std::sqrt((Mxx + Myy) / 2);
}

template <class T> UnweightedMoments unweighted_moments(View<const T> image, double x, double y) {
    CompensatedSum flux, xx, xy, yy;
    for (int64_t j = 0; j < image.ny; ++j) {
        const double dy = static_cast<double>(j) - y;
        for (int64_t i = 0; i < image.nx; ++i) {
            const double value = static_cast<double>(image(i, j));
            const double dx = static_cast<double>(i) - x;
            flux.add(value);
            xx.add(value * dx * dx);
            xy.add(value * dx * dy);
            yy.add(value * dy * dy);
        }
    }
    const double total = checked_flux(flux.value());
    return {total, x, y, xx.value() / total, xy.value() / total, yy.value() / total};
}

template <class T> UnweightedMoments unweighted_moments(View<const T> image) {
    CompensatedSum flux, first_x, first_y;
    const double middle_x = static_cast<double>(image.nx - 1) / 2;
    const double middle_y = static_cast<double>(image.ny - 1) / 2;
    for (int64_t j = 0; j < image.ny; ++j)
        for (int64_t i = 0; i < image.nx; ++i) {
            const double value = static_cast<double>(image(i, j));
            flux.add(value);
            first_x.add(value * (static_cast<double>(i) - middle_x));
            first_y.add(value * (static_cast<double>(j) - middle_y));
        }
    const double total = checked_flux(flux.value());
    return unweighted_moments(image, middle_x + first_x.value() / total,
                              middle_y + first_y.value() / total);
}

template <class T> double pixel_sum(View<const T> image) {
    CompensatedSum total;
    for (int64_t y = 0; y < image.ny; ++y) {
        const T *row = image.row(y);
        double part[8] = {};
        int64_t x = 0;
        for (; x + 8 <= image.nx; x += 8)
            for (int64_t k = 0; k < 8; ++k)
                part[k] += static_cast<double>(row[(x + k) * image.stride_x]);
        for (; x < image.nx; ++x)
            part[0] += static_cast<double>(row[x * image.stride_x]);
        for (const double sum : part)
            total.add(sum);
    }
    return total.value();
}

template double pixel_sum(View<const float>);
template double pixel_sum(View<const double>);
template UnweightedMoments unweighted_moments(View<const float>);
template UnweightedMoments unweighted_moments(View<const double>);
template UnweightedMoments unweighted_moments(View<const float>, double, double);
template UnweightedMoments unweighted_moments(View<const double>, double, double);

} // namespace wfpsf
