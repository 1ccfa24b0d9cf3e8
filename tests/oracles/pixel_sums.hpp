// SPDX-License-Identifier: GPL-3.0-or-later
// Plain sums of waves from many points of a pupil, in some pixels: |A|^2 averaged over each by a
// tensor Gauss rule. A pixel's waves are products, of the wave at its centre and of waves within
// the pixel, which all pixels share.
#pragma once

#include "numerics/dispatch.hpp"
#include "numerics/quadrature.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

namespace wfpsf::oracle {

inline constexpr size_t most_points = 32; // of the rule along an axis

// sum += x[i] y[j] over four points, for all pairs. Most of the time of the tests that use it, so
// that sanitizers leave it alone.
[[gnu::no_sanitize("address", "undefined")]] WFPSF_VECTORISED inline void
add_products(size_t n, const double (*x_re)[most_points], const double (*x_im)[most_points],
             const double (*y_re)[most_points], const double (*y_im)[most_points], double *re,
             double *im) {
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j < n; ++j) {
            double a = re[i * n + j], b = im[i * n + j];
            for (size_t q = 0; q < 4; ++q) {
                a += x_re[q][i] * y_re[q][j] - x_im[q][i] * y_im[q][j];
                b += x_re[q][i] * y_im[q][j] + x_im[q][i] * y_re[q][j];
            }
            re[i * n + j] = a;
            im[i * n + j] = b;
        }
}

class PixelSums {
  public:
    using Complex = std::complex<double>;
    using Amplitudes = std::vector<Complex>; // of one pixel, by point

    // Pixels centred on `angles`; Angle has x and y. The pupil is up to `diameter` wide.
    template <class Angle>
    PixelSums(double pixel_scale, double wavelength, const std::vector<Angle> &angles,
              double diameter = 2.5)
        : scale_(pixel_scale), k_(2 * std::numbers::pi / wavelength),
          // The intensity's waves turn by this much from the middle of a pixel to its edge.
          rule_(points(std::numbers::pi * diameter * pixel_scale / wavelength)) {
        for (const Angle &a : angles)
            centres_.push_back({a.x, a.y});
    }

    double largest_wavenumber() const {
        double most = 0;
        for (const auto &[x, y] : centres_)
            most = std::max(most, std::hypot(std::abs(x) + scale_ / 2, std::abs(y) + scale_ / 2));
        return k_ * most;
    }

    // k theta at a point of a pixel.
    std::array<double, 2> wave(size_t pixel, size_t point) const {
        const size_t n = rule_.x.size();
        return {k_ * (centres_[pixel][0] + rule_.x[point / n] * scale_ / 2),
                k_ * (centres_[pixel][1] + rule_.x[point % n] * scale_ / 2)};
    }

    // Sums of (re + i im) exp(i k.u).
    std::vector<Amplitudes> amplitudes(const std::vector<double> &x, const std::vector<double> &y,
                                       const std::vector<double> &re,
                                       const std::vector<double> &im) const {
        const size_t n = rule_.x.size();
        std::vector<double> sum_re(centres_.size() * n * n), sum_im(sum_re.size());
        using Waves = double[4][most_points];
        Waves in_x_re, in_x_im, in_y_re, in_y_im, x_re, x_im;
        for (size_t first = 0; first < x.size(); first += 4) {
            const size_t count = std::min<size_t>(4, x.size() - first);
            for (size_t q = 0; q < count; ++q)
                for (size_t i = 0; i < (n + 1) / 2; ++i) { // and the mirrored point
                    const double t = k_ * scale_ / 2 * rule_.x[i];
                    in_x_re[q][i] = in_x_re[q][n - 1 - i] = std::cos(t * x[first + q]);
                    in_x_im[q][i] = std::sin(t * x[first + q]);
                    in_x_im[q][n - 1 - i] = -in_x_im[q][i];
                    in_y_re[q][i] = in_y_re[q][n - 1 - i] = std::cos(t * y[first + q]);
                    in_y_im[q][i] = std::sin(t * y[first + q]);
                    in_y_im[q][n - 1 - i] = -in_y_im[q][i];
                }
            for (size_t p = 0; p < centres_.size(); ++p) {
                for (size_t q = 0; q < 4; ++q) {
                    Complex weight = 0;
                    if (q < count)
                        weight = Complex(re[first + q], im[first + q]) *
                                 std::polar(1.0, k_ * (x[first + q] * centres_[p][0] +
                                                       y[first + q] * centres_[p][1]));
                    for (size_t i = 0; i < n; ++i) {
                        x_re[q][i] = q < count ? weight.real() * in_x_re[q][i] -
                                                     weight.imag() * in_x_im[q][i]
                                               : 0;
                        x_im[q][i] = q < count ? weight.real() * in_x_im[q][i] +
                                                     weight.imag() * in_x_re[q][i]
                                               : 0;
                        if (q >= count)
                            in_y_re[q][i] = in_y_im[q][i] = 0;
                    }
                }
                add_products(n, x_re, x_im, in_y_re, in_y_im, &sum_re[p * n * n],
                             &sum_im[p * n * n]);
            }
        }
        std::vector<Amplitudes> out(centres_.size());
        for (size_t p = 0; p < centres_.size(); ++p)
            for (size_t j = p * n * n; j < (p + 1) * n * n; ++j)
                out[p].emplace_back(sum_re[j], sum_im[j]);
        return out;
    }

    // Fractions of the light that passes a pupil of the given area.
    std::vector<double> pixels(const std::vector<Amplitudes> &amplitudes, double area) const {
        const size_t n = rule_.x.size();
        const double solid_angle = k_ * scale_ / (2 * std::numbers::pi);
        std::vector<double> out;
        for (const Amplitudes &amplitude : amplitudes) {
            double sum = 0;
            for (size_t j = 0; j < n * n; ++j)
                sum += rule_.w[j / n] * rule_.w[j % n] / 4 * std::norm(amplitude[j]);
            out.push_back(sum * solid_angle * solid_angle / area);
        }
        return out;
    }

  private:
    // Even, so that no point is on the axis.
    static int points(double phase) { return (gauss_legendre_points(phase, 1e-14) + 1) / 2 * 2; }

    double scale_, k_;
    GaussLegendre rule_;
    std::vector<std::array<double, 2>> centres_;
};

} // namespace wfpsf::oracle
