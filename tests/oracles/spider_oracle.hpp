// SPDX-License-Identifier: GPL-3.0-or-later
// The transform of an obscured disc behind struts by lines of constant y: the lit spans of a line
// are found from the definition, the integral along each is exact, and that across the lines is a
// composite Gauss rule between all heights at which a span may begin, end or bend. Waves of up to
// 60 radians per unit of length are integrated to about 1e-13.
#pragma once

#include "instrument/pupil.hpp"
#include "numerics/quadrature.hpp"
#include "oracles/psf_oracle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

namespace wfpsf::oracle {

class SpiderScan {
  public:
    // The outer radius is about 1.
    explicit SpiderScan(const SpiderPupil &pupil) : pupil_(pupil) {
        const GaussLegendre rule(12);
        const std::vector<double> y = breaks();
        for (size_t i = 0; i + 1 < y.size(); ++i) {
            const double half = (y[i + 1] - y[i]) / 2;
            for (size_t k = 0; k < rule.x.size(); ++k)
                add_line(y[i] + half * (1 + rule.x[k]), rule.w[k] * half);
        }
    }

    double area() const { return transform(0, 0).real(); }

    // Integral of exp(i (kx x + ky y)).
    std::complex<double> transform(double kx, double ky) const {
        std::complex<double> sum = 0;
        for (const Span &span : spans_)
            sum += along(span, kx) * std::polar(1.0, ky * span.y);
        return sum;
    }

    // The fraction of the light in the pixel centred on an angle.
    double in_pixel(double x, double y, double pixel_scale, double wavelength) const {
        constexpr size_t points = 10;
        const GaussLegendre rule(points);
        std::array<std::array<std::complex<double>, points>, points> amplitude{};
        const double k = 2 * pi / wavelength;
        for (const Span &span : spans_) {
            std::array<std::complex<double>, points> across;
            for (size_t j = 0; j < points; ++j)
                across[j] = std::polar(1.0, k * (y + rule.x[j] * pixel_scale / 2) * span.y);
            for (size_t i = 0; i < points; ++i) {
                const auto here = along(span, k * (x + rule.x[i] * pixel_scale / 2));
                for (size_t j = 0; j < points; ++j)
                    amplitude[i][j] += here * across[j];
            }
        }
        double sum = 0;
        for (size_t i = 0; i < points; ++i)
            for (size_t j = 0; j < points; ++j)
                sum += rule.w[i] * rule.w[j] / 4 * std::norm(amplitude[i][j]);
        return sum * pixel_scale * pixel_scale / (area() * wavelength * wavelength);
    }

  private:
    struct Span {
        double y, weight, x0, x1;
    };
    static std::complex<double> along(const Span &span, double kx) {
        const double half = kx * (span.x1 - span.x0) / 2;
        return std::polar(span.weight * (span.x1 - span.x0) *
                              (half == 0 ? 1 : std::sin(half) / half),
                          kx * (span.x0 + span.x1) / 2);
    }
    struct Line { // nx x + ny y = d
        double nx, ny, d;
    };

    std::vector<double> breaks() const {
        const double outer = pupil_.outer_radius, inner = pupil_.inner_radius;
        std::vector<double> y{-outer, -inner, inner, outer};
        for (double at = -outer; at < outer; at += 0.1)
            y.push_back(at);
        // Closer and closer towards where a circle turns, for the root that its chord has there.
        for (const double radius : {outer, inner})
            for (double distance = outer; distance > 1e-10 * outer; distance /= 3)
                for (const double side : {-1.0, 1.0}) {
                    y.push_back(side * (radius - distance));
                    y.push_back(side * (radius + distance));
                }
        std::vector<Line> lines;
        for (const Strut &s : pupil_.struts)
            for (const Line &line :
                 {Line{s.nx, s.ny, s.offset - s.width / 2},
                  Line{s.nx, s.ny, s.offset + s.width / 2}, Line{-s.ny, s.nx, 0}})
                lines.push_back(line);
        for (const Line &a : lines) {
            for (const double radius : {outer, inner})
                if (radius > std::abs(a.d))
                    for (const double side : {-1.0, 1.0})
                        y.push_back(a.d * a.ny +
                                    side * a.nx * std::sqrt(radius * radius - a.d * a.d));
            for (const Line &b : lines)
                if (const double det = a.nx * b.ny - a.ny * b.nx; std::abs(det) > 1e-14)
                    y.push_back((a.nx * b.d - a.d * b.nx) / det);
        }
        std::erase_if(y, [=](double at) { return std::abs(at) > outer; });
        std::ranges::sort(y);
        return y;
    }

    void add_line(double y, double weight) {
        // Dark runs of the line, from the left.
        std::vector<std::pair<double, double>> dark;
        const auto chord = [y](double r) { return std::sqrt(std::max(0.0, r * r - y * y)); };
        if (const double half = chord(pupil_.inner_radius); half > 0)
            dark.emplace_back(-half, half);
        for (const Strut &s : pupil_.struts) {
            double low = -1e9, high = 1e9;
            // Keeps what has n x >= d.
            const auto keep = [&](double n, double d) {
                if (n > 0)
                    low = std::max(low, d / n);
                else if (n < 0)
                    high = std::min(high, d / n);
                else if (d > 0)
                    high = -1e9;
            };
            keep(s.nx, s.offset - s.width / 2 - s.ny * y);
            keep(-s.nx, -s.offset - s.width / 2 + s.ny * y);
            keep(-s.ny, -s.nx * y);
            if (high > low)
                dark.emplace_back(low, high);
        }
        std::ranges::sort(dark);
        double x = -chord(pupil_.outer_radius);
        const double end = -x;
        for (const auto &[low, high] : dark) {
            if (std::min(low, end) > x)
                spans_.push_back({y, weight, x, std::min(low, end)});
            x = std::max(x, high);
        }
        if (end > x)
            spans_.push_back({y, weight, x, end});
    }

    SpiderPupil pupil_;
    std::vector<Span> spans_;
};

} // namespace wfpsf::oracle
