// SPDX-License-Identifier: GPL-3.0-or-later
// Noll's Zernike polynomials (Noll 1976, Eqs. 1 and 2), term by term in polar coordinates.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

namespace wfpsf::oracle {

class ZernikeWaves {
  public:
    // coefficients[j - 1] belongs to Z_j.
    ZernikeWaves(const std::vector<double> &coefficients, double radius) : radius_(radius) {
        int j = 0;
        for (int n = 0; static_cast<size_t>(j) < coefficients.size(); ++n) {
            // Of one radial order by rising m; of the two of an m the even j is the cosine.
            for (int m = n % 2; m <= n; m += 2)
                for (int twin = 0; twin < (m == 0 ? 1 : 2); ++twin) {
                    if (static_cast<size_t>(j++) >= coefficients.size())
                        return;
                    const double a = coefficients[static_cast<size_t>(j - 1)];
                    if (a != 0)
                        add(n, m, m == 0 || j % 2 == 0, a);
                }
        }
    }

    double operator()(double x, double y) const {
        const std::complex<double> z(x / radius_, y / radius_);
        const double r2 = std::norm(z);
        double sum = 0;
        for (const Term &t : terms_) {
            double radial = 0;
            for (const double c : t.radial) // falling powers of r, two apart
                radial = radial * r2 + c;
            std::complex<double> turned = 1; // r^m exp(i m theta)
            for (int i = 0; i < t.m; ++i)
                turned *= z;
            sum += radial * (t.cosine ? turned.real() : turned.imag());
        }
        return sum;
    }

    // Of the gradient in the disc, from differences.
    double largest_slope() const {
        constexpr double h = 1e-4;
        double most = 0;
        for (double x = -1; x <= 1; x += 0.05)
            for (double y = -1; y <= 1; y += 0.05)
                if (std::hypot(x, y) <= 1.05) {
                    const double u = x * radius_, v = y * radius_;
                    const double dx = (*this)(u + h, v) - (*this)(u - h, v);
                    const double dy = (*this)(u, v + h) - (*this)(u, v - h);
                    most = std::max(most, std::hypot(dx, dy) / (2 * h));
                }
        return 1.2 * most;
    }

  private:
    struct Term {
        int m;
        bool cosine;
        std::vector<double> radial;
    };
    void add(int n, int m, bool cosine, double a) {
        const auto factorial = [](int k) {
            long double product = 1;
            for (int i = 2; i <= k; ++i)
                product *= i;
            return product;
        };
        Term term{m, cosine, {}};
        const double norm = a * std::sqrt((n + 1.0) * (m == 0 ? 1 : 2));
        for (int s = 0; 2 * s <= n - m; ++s)
            term.radial.push_back(static_cast<double>(
                norm * (s % 2 ? -1 : 1) * factorial(n - s) /
                (factorial(s) * factorial((n + m) / 2 - s) * factorial((n - m) / 2 - s))));
        terms_.push_back(term);
    }

    double radius_;
    std::vector<Term> terms_;
};

} // namespace wfpsf::oracle
