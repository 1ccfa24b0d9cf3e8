// SPDX-License-Identifier: GPL-3.0-or-later
#include "error/error.hpp"
#include "gaussian_image.hpp"
#include "moments/encircled.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <utility>

namespace wfpsf {
namespace {

constexpr double pi = std::numbers::pi;

// J1(x)/x
double jinc(double x) {
    return x < 1e-8 ? 0.5 : std::cyl_bessel_j(1.0, x) / x;
}

// An annular pupil of obscuration e in focus, unit flux, with its band edge at `bandwidth` cycles
// per sample: v = pi bandwidth r.
struct ObscuredAiry {
    double bandwidth, e;

    double at(double r) const {
        const double v = pi * bandwidth * r;
        const double amplitude = 2 * (jinc(v) - e * e * jinc(e * v)) / (1 - e * e);
        return amplitude * amplitude * pi * bandwidth * bandwidth * (1 - e * e) / 4;
    }
    Plane<double> image(int64_t n, double x0, double y0) const {
        Plane<double> out(n, n);
        for (int64_t y = 0; y < n; ++y)
            for (int64_t x = 0; x < n; ++x)
                out(x, y) =
                    at(std::hypot(static_cast<double>(x) - x0, static_cast<double>(y) - y0));
        return out;
    }
    // Born & Wolf, section 8.5, for a full aperture; the cross term by Simpson's rule,
    // extrapolated.
    double encircled(double r) const {
        const double v = pi * bandwidth * r;
        const auto full = [](double u) {
            const double j0 = std::cyl_bessel_j(0.0, u), j1 = std::cyl_bessel_j(1.0, u);
            return 1 - j0 * j0 - j1 * j1;
        };
        const auto cross = [&](double t) {
            return t == 0 ? 0 : std::cyl_bessel_j(1.0, t) * std::cyl_bessel_j(1.0, e * t) / t;
        };
        const auto simpson = [&](int n) {
            double sum = cross(0) + cross(v);
            for (int i = 1; i < n; ++i)
                sum += (i % 2 ? 4 : 2) * cross(v * i / n);
            return sum * v / n / 3;
        };
        const double sum = (16 * simpson(2000) - simpson(1000)) / 15;
        return (full(v) + e * e * full(e * v) - 4 * e * sum) / (1 - e * e);
    }
};

TEST(Encircled, ObscuredAiryAgreesWithItsClosedForm) {
    // The filter sees nothing of the image's border: it is 1e-6 of the peak, so 1e-10 is asked of
    // radii that stay a filter's length inside, with the border's doubt in the estimate.
    for (const double bandwidth : {0.1, 0.25, 0.35}) {
        const ObscuredAiry airy{bandwidth, 0.303};
        const double x = 150.23, y = 149.61;
        const Plane<double> image = airy.image(300, x, y);
        for (const double turns : {0.3, 1.2, 4.0, 10.0}) {
            const double r = turns / bandwidth;
            if (r > 100)
                continue;
            const DiscLight result = disc_light(view_of(image), x, y, r, {.bandwidth = bandwidth});
            EXPECT_NEAR(result.energy, airy.encircled(r), 1e-11) << bandwidth << " " << r;
            EXPECT_NEAR(result.density, 2 * pi * r * airy.at(r), 1e-11);
            EXPECT_LE(std::abs(result.energy - airy.encircled(r)), result.energy_error);
            EXPECT_LE(result.energy_error, 1e-10);
        }
        for (const double fraction : {0.3, 0.5, 0.8}) {
            const Estimated found =
                encircled_radius(view_of(image), x, y, fraction, 1, {.bandwidth = bandwidth});
            EXPECT_NEAR(airy.encircled(found.value), fraction, 1e-11);
            EXPECT_LE(found.error_estimate, 1e-8);
        }
    }
}

TEST(Encircled, LooserEpsKeepsItsWord) {
    const ObscuredAiry airy{0.25, 0.2};
    const Plane<double> image = airy.image(120, 60.4, 59.3);
    for (double eps = 1e-2; eps > 1e-12; eps /= 10) {
        const DiscLight result =
            disc_light(view_of(image), 60.4, 59.3, 9.3, {.bandwidth = 0.25, .eps = eps});
        const double error = std::abs(result.energy - airy.encircled(9.3));
        EXPECT_LE(error, eps * airy.at(0) * pi * 9.3 * 9.3);
    }
}

// The disc's light, its derivatives by the radius, and what is made of them: every estimate holds.
TEST(Encircled, EstimatesHoldOverASweepOfEps) {
    const double x = 60.4, y = 59.3;
    const auto airy_at = [](double bandwidth) { return ObscuredAiry{bandwidth, 0.3}; };
    const Plane<double> image = airy_at(0.25).image(120, x, y);
    const ObscuredAiry airy = airy_at(0.25);
    const auto derivative = [](auto f, double r) { // of sixth order
        const double h = 0.02;
        return (45 * (f(r + h) - f(r - h)) - 9 * (f(r + 2 * h) - f(r - 2 * h)) + f(r + 3 * h) -
                f(r - 3 * h)) /
               (60 * h);
    };
    const auto density = [&](double r) { return 2 * pi * r * airy.at(r); };
    const double radius = 9.3, slack = 1e-10; // of the differences
    double low = 1, high = 6;                 // where the profile is half of its centre
    while (high - low > 1e-13)
        (airy.at((low + high) / 2) > airy.at(0) / 2 ? low : high) = (low + high) / 2;
    for (double eps = 1e-2; eps > 1e-12; eps /= 10) {
        const EncircledOptions options{.bandwidth = 0.25, .eps = eps};
        const DiscLight light = disc_light(view_of(image), x, y, radius, options);
        EXPECT_NEAR(light.energy, airy.encircled(radius), light.energy_error) << eps;
        EXPECT_NEAR(light.density, density(radius), light.density_error) << eps;
        EXPECT_NEAR(light.slope, derivative(density, radius), light.slope_error + slack) << eps;
        EXPECT_LE(light.slope_error, 100 * eps + 1e-7);
        for (const double r : {0.0, 2.0, 17.5}) {
            const Estimated mean = ring_mean(view_of(image), x, y, r, options);
            EXPECT_NEAR(mean.value, airy.at(r), mean.error_estimate) << eps << " " << r;
            EXPECT_LE(mean.error_estimate, eps * airy.at(0) + 1e-7);
        }
        const Estimated width = profile_fwhm(view_of(image), x, y, options);
        EXPECT_NEAR(width.value, low + high, width.error_estimate) << eps;
        EXPECT_LE(width.error_estimate, 30 * eps + 1e-6);
    }
}

// The radius' derivatives along two changes against differences of whole measurements.
TEST(Encircled, DerivativesAgreeWithFiniteDifferences) {
    const double x = 60.4, y = 59.3, fraction = 0.5, total = 1;
    const EncircledOptions precise{.bandwidth = 0.25, .eps = 1e-13};
    const Plane<double> image = ObscuredAiry{0.25, 0.3}.image(120, x, y);
    const Plane<double> a = gaussian_image(120, 120, gaussian_of(62, 58, 4, 0.2, 0), 0.3);
    Plane<double> b = gaussian_image(120, 120, gaussian_of(57, 61, 3, 0, -0.3), -0.4);
    add_gaussian(b.view(), gaussian_of(60, 60, 6, 0, 0), 0.4);
    const double total_a = 0.3, total_b = 0; // of their pixels, to rounding
    const auto measured = [&](double s, double t) {
        Plane<double> sum(120, 120);
        for (int64_t j = 0; j < 120; ++j)
            for (int64_t i = 0; i < 120; ++i)
                sum(i, j) = image(i, j) + s * a(i, j) + t * b(i, j);
        return encircled_radius(view_of(sum), x, y, fraction, total + s * total_a + t * total_b,
                                precise)
            .value;
    };
    const auto extrapolated = [](auto f, double h) {
        const double one = f(h), two = f(2 * h), four = f(4 * h);
        return (16 * (4 * one - two) / 3 - (4 * two - four) / 3) / 15;
    };
    const double slope_a =
        extrapolated([&](double h) { return (measured(h, 0) - measured(-h, 0)) / (2 * h); }, 5e-3);
    const auto mixed = [&](double h) {
        return (measured(h, h) - measured(h, -h) - measured(-h, h) + measured(-h, -h)) /
               (4 * h * h);
    };
    const double curvature_ab = extrapolated(mixed, 1e-2);
    const double curvature_aa = extrapolated(
        [&](double h) { return (measured(h, 0) - 2 * measured(0, 0) + measured(-h, 0)) / (h * h); },
        1e-2);
    for (const double eps : {1e-4, 1e-6, 1e-9, 1e-12}) {
        const EncircledOptions options{.bandwidth = 0.25, .eps = eps};
        const Estimated r = encircled_radius(view_of(image), x, y, fraction, total, options);
        const auto on = [&](const Plane<double> &plane) {
            return disc_light(view_of(plane), x, y, r.value, options);
        };
        const HeldChange by_a{on(a), fraction * total_a}, by_b{on(b), fraction * total_b};
        const DiscLight light = on(image);
        const Estimated slope = radius_slope(r, light, by_a);
        EXPECT_NEAR(slope.value, slope_a, slope.error_estimate + 1e-8) << eps;
        EXPECT_LE(slope.error_estimate, 1e4 * eps + 1e-7);
        const Estimated ab = radius_curvature(r, light, by_a, by_b, options);
        EXPECT_NEAR(ab.value, curvature_ab, ab.error_estimate + 1e-7) << eps;
        const Estimated aa = radius_curvature(r, light, by_a, by_a, options);
        EXPECT_NEAR(aa.value, curvature_aa, aa.error_estimate + 1e-7) << eps;
        EXPECT_LE(aa.error_estimate, 1e5 * eps + 1e-6);
        EXPECT_GT(std::abs(aa.value), 1e-3);
    }
}

TEST(Encircled, GaussianIsTheSameInEveryView) {
    const double sigma = 4, x = 40.3, y = 38.8;
    const Plane<double> image = gaussian_image(80, 80, gaussian_of(x, y, sigma, 0, 0), 5);
    const double expected = sigma * std::sqrt(2 * std::log(2.0));
    const Estimated r = encircled_radius(view_of(image), x, y, 0.5, 5);
    EXPECT_NEAR(r.value, expected, 1e-11);
    const View<const double> flipped{&image(79, 79), 80, 80, -1, -80};
    EXPECT_NEAR(encircled_radius(flipped, 79 - x, 79 - y, 0.5, 5).value, expected, 1e-11);
    Plane<float> single(80, 80);
    add_gaussian(single.view(), gaussian_of(x, y, sigma, 0, 0), 5);
    EXPECT_NEAR(encircled_radius(std::as_const(single).view(), x, y, 0.5, 5).value, expected, 1e-5);
}

// Content above the stated bandwidth shows in the error estimate.
TEST(Encircled, UndersampledImagesAreFoundOut) {
    const ObscuredAiry airy{0.45, 0.3};
    const Plane<double> image = airy.image(60, 30.2, 29.7);
    const DiscLight result = disc_light(view_of(image), 30.2, 29.7, 6.3, {.bandwidth = 0.1});
    EXPECT_GT(result.energy_error, 1e-6);
}

TEST(Encircled, ErrorsNameTheCause) {
    Plane<double> image = gaussian_image(40, 40, gaussian_of(20, 20, 3, 0, 0));
    const View<const double> v = view_of(image);
    const auto thrown = [&](auto call) {
        try {
            call();
        } catch (const Error &error) {
            return error.status();
        }
        return static_cast<wfpsf_status>(WFPSF_OK);
    };
    EXPECT_EQ(thrown([&] { encircled_radius(v, 20, 20, 0.5, 3); }), WFPSF_ERROR_SIZE_NOT_REACHED);
    EXPECT_EQ(thrown([&] { encircled_radius(v, -5, 20, 0.5, 1); }), WFPSF_ERROR_SIZE_NOT_REACHED);
    EXPECT_EQ(thrown([&] { disc_light(v, 20, 20, 19.5); }), WFPSF_ERROR_SIZE_NOT_REACHED);
    EXPECT_EQ(thrown([&] { disc_light(v, 20, 20, -1); }), WFPSF_ERROR_RANGE);
    EXPECT_EQ(thrown([&] { encircled_radius(v, 20, 20, 0, 1); }), WFPSF_ERROR_RANGE);
    EXPECT_EQ(thrown([&] { encircled_radius(v, 20, 20, 0.5, 0); }), WFPSF_ERROR_RANGE);
    EXPECT_EQ(thrown([&] { disc_light(v, 20, 20, 1, {.bandwidth = 0.5}); }), WFPSF_ERROR_RANGE);
    EXPECT_EQ(thrown([&] { disc_light(v, 20, 20, 1, {.eps = 0}); }), WFPSF_ERROR_RANGE);
    EXPECT_EQ(thrown([&] { disc_light(v, NAN, 20, 1); }), WFPSF_ERROR_NOT_FINITE);
    const Plane<double> zero(40, 40);
    EXPECT_EQ(thrown([&] { encircled_radius(view_of(zero), 20, 20, 0.5, 1); }),
              WFPSF_ERROR_SIZE_NOT_REACHED);
    image(3, 3) = std::numeric_limits<double>::infinity();
    EXPECT_EQ(thrown([&] { disc_light(v, 20, 20, 1); }), WFPSF_ERROR_NOT_FINITE);
}

} // namespace
} // namespace wfpsf
