// SPDX-License-Identifier: GPL-3.0-or-later
#include "error/error.hpp"
#include "numerics/quadrature.hpp"
#include "scene/sersic.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <utility>

namespace wfpsf {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double indices[] = {0.3, 0.42, 0.5, 0.75, 1, 1.3, 2, 3, 4, 5.1, 6.2};

// Integral of I(r) 2 pi r f(r) dr to r = last; by r = t^(4 n), after which cusps are smooth.
template <class F> double integrate(const Sersic &s, double last, F f) {
    static const GaussLegendre rule(40);
    const double n = 4 * std::max(1.0, s.index()), end = std::pow(last, 1 / n);
    constexpr int panels = 200;
    double sum = 0;
    for (int p = 0; p < panels; ++p)
        for (size_t i = 0; i < rule.x.size(); ++i) {
            const double t = end * (p + (1 + rule.x[i]) / 2) / panels, r = std::pow(t, n);
            sum += rule.w[i] / 2 * end / panels * n * std::pow(t, n - 1) * 2 * pi * r *
                   s.brightness(r) * f(r);
        }
    return sum;
}

double whole(const Sersic &s) {
    return std::pow(100 / s.b(), s.index());
}

TEST(Sersic, HalfTheLightIsWithinTheHalfLightRadius) {
    EXPECT_DOUBLE_EQ(Sersic(0.5).b(), std::numbers::ln2);
    EXPECT_NEAR(Sersic(1).b(), 1.6783469900166605, 1e-15);
    EXPECT_NEAR(Sersic(4).b(), 7.669249442500804, 4e-15);
    for (const double n : indices) {
        const Sersic s(n);
        EXPECT_NEAR(integrate(s, 1, [](double) { return 1; }), 0.5, 3e-14) << n;
        EXPECT_NEAR(integrate(s, whole(s), [](double) { return 1; }), 1, 3e-14) << n;
        EXPECT_EQ(s.enclosed(0), 0);
        for (const double r : {0.01, 0.7, 1.5, 4.0, 50.0})
            EXPECT_NEAR(s.enclosed(r), integrate(s, r, [](double) { return 1; }), 3e-14) << n;
        EXPECT_NEAR(integrate(s, whole(s), [](double r) { return r * r; }) / s.mean_square_radius(),
                    1, 1e-11)
            << n;
        // The median of the gamma distribution: Choi 1994, Proc. Am. Math. Soc. 121, 245.
        if (n > 1.5) {
            EXPECT_NEAR(s.b(),
                        2 * n - 1.0 / 3 + 4 / (405 * n) + 46 / (25515 * n * n) +
                            281 / (3444525 * n * n * n) -
                            19006408 / (16 * 15345358875 * n * n * n * n),
                        1e-4 * std::pow(n, -5));
        }
    }
}

TEST(Sersic, RadiusOfABrightnessIsItsInverse) {
    for (const double n : indices) {
        const Sersic s(n);
        for (const double r : {0.1, 0.3, 1.0, 7.0})
            EXPECT_NEAR(s.radius_of(s.brightness(r)) / r, 1, 1e-9) << n << ' ' << r;
        EXPECT_EQ(s.radius_of(1.01 * s.brightness(0)), 0);
    }
}

TEST(SersicTransform, MeetsClosedForms) {
    const Sersic gaussian(0.5), exponential(1);
    for (double k = 1e-8; k < 1e9; k *= 1.0371) {
        EXPECT_NEAR(gaussian.transform(k), std::exp(-k * k / (4 * gaussian.b())),
                    SersicTable::error);
        EXPECT_NEAR(exponential.transform(k),
                    std::pow(1 + k * k / (exponential.b() * exponential.b()), -1.5),
                    SersicTable::error);
    }
    for (const double n : indices) {
        EXPECT_NEAR(Sersic(n).transform(0), 1, SersicTable::error);
        EXPECT_EQ(Sersic(n).transform(1e200), 0);
    }
}

TEST(SersicTransform, MeetsPlainQuadrature) {
    for (const double n : indices) {
        const Sersic s(n);
        for (double k = 1e-3; k < 20; k *= 1.731)
            // Beyond that radius the Bessel function turns too often for the rule, and for n > 2
            // there is light: what is left out is less than its share.
            if (k * whole(s) < 3000) {
                EXPECT_NEAR(
                    s.transform(k),
                    integrate(s, whole(s), [=](double r) { return std::cyl_bessel_j(0, k * r); }),
                    SersicTable::error)
                    << n << ' ' << k;
            }
    }
}

// For n < 1 the moments' series converges everywhere, for n > 1 that of the cusp's powers: where
// their terms do not cancel too much they are the truth.
TEST(SersicTransform, MeetsItsSeries) {
    int compared = 0;
    for (const double n : indices) {
        const Sersic s(n);
        const long double b = s.b(), index = n;
        for (long double k = 1e-5L; k < 1e7L; k *= 1.217L) {
            long double sum = 0, largest = 0, term = 1;
            for (int j = n < 1 ? 0 : 1; j < 400; ++j) {
                if (n < 1) {
                    const int m = j;
                    term = std::exp(2 * m * std::log(k / 2) - 2 * std::lgamma(m + 1.0L) +
                                    std::lgamma(2 * index * (1 + m)) - std::lgamma(2 * index) -
                                    2 * index * m * std::log(b)) *
                           (m % 2 == 0 ? 1 : -1);
                } else {
                    const long double z = j / (2 * index);
                    const long double pi_long = std::numbers::pi_v<long double>;
                    // 1 / Gamma(-z) = -sin(pi z) Gamma(1 + z) / pi
                    term = -std::exp(2 * index * std::log(b) + j * std::log(b) -
                                     std::lgamma(j + 1.0L) + (1 + 2 * z) * std::log(2.0L) +
                                     2 * std::lgamma(1 + z) - (2 + 2 * z) * std::log(k) -
                                     std::lgamma(2 * index)) /
                           index * std::sin(pi_long * z) / pi_long * (j % 2 == 0 ? 1 : -1);
                }
                sum += term;
                largest = std::max(largest, std::abs(term));
            }
            if (largest > 1e6L || std::abs(term) > 1e-12L)
                continue;
            ++compared;
            EXPECT_NEAR(s.transform(static_cast<double>(k)), static_cast<double>(sum),
                        SersicTable::error)
                << n << ' ' << k;
        }
    }
    EXPECT_GT(compared, 500);
}

TEST(Sersic, RefusesOtherIndices) {
    for (const double n : {0.29, 6.21, 0.0, -1.0, std::nan(""), HUGE_VAL}) {
        try {
            const Sersic s(n);
            FAIL() << n;
        } catch (const Error &error) {
            EXPECT_EQ(error.status(), WFPSF_ERROR_RANGE);
            EXPECT_NE(std::string(error.what()).find("sersic_index"), std::string::npos);
        }
    }
}

} // namespace
} // namespace wfpsf
