// SPDX-License-Identifier: GPL-3.0-or-later
// Truth to hold PSFs against, by means that share no code with the engine beyond the nodes of the
// pupil (which are tested against a raster of its definition).
#pragma once

#include "instrument/pupil.hpp"
#include "numerics/quadrature.hpp"
#include "optics/pupil_nodes.hpp"
#include "optics/wavefront.hpp"

#include <cmath>
#include <complex>
#include <cstddef>
#include <functional>
#include <numbers>
#include <vector>

namespace wfpsf::oracle {

inline constexpr double pi = std::numbers::pi;

using Intensity = std::function<double(double, double)>; // at angles, per radian^2

// The light in the native pixel centred on an angle, by a tensor Gauss rule.
inline double in_pixel(const Intensity &intensity, double x, double y, double pixel_scale) {
    const GaussLegendre rule(16);
    double sum = 0;
    for (size_t i = 0; i < rule.x.size(); ++i)
        for (size_t j = 0; j < rule.x.size(); ++j)
            sum += rule.w[i] * rule.w[j] / 4 *
                   intensity(x + rule.x[i] * pixel_scale / 2, y + rule.x[j] * pixel_scale / 2);
    return sum * pixel_scale * pixel_scale;
}

// |A|^2 / (area lambda^2) by a plain sum over nodes; take them far finer than the engine's.
inline Intensity brute_force(const PupilNodes &nodes, const Wavefront &wavefront,
                             double wavelength) {
    std::vector<std::complex<double>> field(nodes.size());
    double area = 0;
    for (size_t n = 0; n < nodes.size(); ++n) {
        field[n] = nodes.weight[n] * std::polar(1.0, 2 * pi * wavefront(nodes.x[n], nodes.y[n]));
        area += nodes.weight[n];
    }
    return [=](double x, double y) {
        std::complex<double> sum = 0;
        for (size_t n = 0; n < nodes.size(); ++n)
            sum +=
                field[n] * std::polar(1.0, 2 * pi / wavelength * (x * nodes.x[n] + y * nodes.y[n]));
        return std::norm(sum) / (area * wavelength * wavelength);
    };
}

// in_pixel() of brute_force(), by products of waves along x and along y.
inline double brute_force_in_pixel(const PupilNodes &nodes, const Wavefront &wavefront,
                                   double wavelength, double x, double y, double pixel_scale,
                                   int points) {
    using Complex = std::complex<double>;
    const GaussLegendre rule(points);
    const size_t n = rule.x.size();
    const double k = 2 * pi / wavelength;
    std::vector<Complex> amplitude(n * n), along_x(n), along_y(n);
    double area = 0;
    for (size_t i = 0; i < nodes.size(); ++i) {
        area += nodes.weight[i];
        const double phase = 2 * pi * wavefront(nodes.x[i], nodes.y[i]);
        for (size_t j = 0; j < n; ++j) {
            const double offset = rule.x[j] * pixel_scale / 2;
            along_x[j] = std::polar(1.0, k * nodes.x[i] * (x + offset));
            along_y[j] = std::polar(nodes.weight[i], k * nodes.y[i] * (y + offset) + phase);
        }
        for (size_t j = 0; j < n * n; ++j) {
            const Complex &a = along_x[j % n], &b = along_y[j / n];
            amplitude[j] += Complex(a.real() * b.real() - a.imag() * b.imag(),
                                    a.real() * b.imag() + a.imag() * b.real());
        }
    }
    double sum = 0;
    for (size_t j = 0; j < n * n; ++j)
        sum += rule.w[j % n] * rule.w[j / n] / 4 * std::norm(amplitude[j]);
    return sum * pixel_scale * pixel_scale / (area * wavelength * wavelength);
}

// The obscured Airy pattern; at the angles of interest the argument is never exactly zero.
inline Intensity airy(const AnnularPupil &pupil, double wavelength) {
    return [=](double x, double y) {
        const double k = 2 * pi * std::hypot(x, y) / wavelength;
        const double r = pupil.outer_radius, q = pupil.inner_radius;
        const double amplitude =
            2 * pi * (r * std::cyl_bessel_j(1, k * r) - q * std::cyl_bessel_j(1, k * q)) / k;
        return amplitude * amplitude / (pi * (r * r - q * q) * wavelength * wavelength);
    };
}

} // namespace wfpsf::oracle
