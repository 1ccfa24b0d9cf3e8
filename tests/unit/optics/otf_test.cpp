// SPDX-License-Identifier: GPL-3.0-or-later
#include "instrument/instrument.hpp"
#include "optics/otf.hpp"
#include "optics/psf.hpp"
#include "optics/roman_region.hpp"
#include "oracles/otf_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace wfpsf {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double wavelength = 1500e-9;
constexpr double pixel_scale = 0.11 * pi / 180 / 3600;
using Complex = std::complex<double>;

// Area that two discs share.
double lens(double r, double q, double distance) {
    if (distance >= r + q)
        return 0;
    if (distance <= std::abs(r - q))
        return pi * std::min(r, q) * std::min(r, q);
    const double a = (distance * distance + r * r - q * q) / (2 * distance), b = distance - a;
    return r * r * std::acos(a / r) - a * std::sqrt(r * r - a * a) + q * q * std::acos(b / q) -
           b * std::sqrt(q * q - b * b);
}

// O'Neill 1956, J. Opt. Soc. Am. 46, 285: the annulus.
double annulus_otf(const AnnularPupil &p, double k) {
    const double shift = k * wavelength, r = p.outer_radius, q = p.inner_radius;
    return (lens(r, r, shift) - 2 * lens(r, q, shift) + lens(q, q, shift)) / (pi * (r * r - q * q));
}

Wavefront aberrated() {
    return Wavefront(std::vector<double>{0, 0, 0, 0.1, -0.06, 0.05, 0.04, -0.07, 0.02, 0.03, 0.05},
                     1.18);
}

// Holds an OTF against the truth at many frequencies, those near zero and a pixel's shift included.
template <class Truth>
void expect_within_estimates(const Otf &otf, int steps, const Truth &truth, const char *what) {
    double difference = 0, whole = 0, largest = 0;
    const auto compare = [&](double kx, double ky) {
        const Complex wanted = truth(kx, ky);
        const double off = std::abs(otf.diffraction(kx, ky) - wanted);
        largest = std::max(largest, off);
        return std::pair(off, std::abs(wanted));
    };
    for (int j = 0; j < steps; ++j)
        for (int i = -steps; i < steps; ++i) {
            const auto [off, size] = compare(otf.cutoff() * (i + 0.37 + 0.1 * (j % 5)) / steps,
                                             otf.cutoff() * (j + 0.61) / steps);
            difference += off;
            whole += size;
        }
    for (int i = 0; i < 2 * steps; ++i) {
        const double k = otf.cutoff() / static_cast<double>(otf.pixels()) * i * 0.05;
        compare(k * std::cos(i), k * std::sin(i));
    }
    EXPECT_LE(difference / whole, otf.error_estimate()) << what;
    EXPECT_LE(largest, otf.value_error()) << what;
}

TEST(Otf, AnnulusMeetsItsClosedFormAtEveryTolerance) {
    const AnnularPupil annulus = Instrument::get("wfirst-afta-c5").annular_pupil();
    const Component component{make_aperture(annulus), Wavefront({}, 1.18), wavelength, 1};
    for (const double eps : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
        const Otf otf({&component, 1}, pixel_scale, false, eps);
        EXPECT_LE(otf.error_estimate(), eps);
        expect_within_estimates(
            otf, 100,
            [&](double kx, double ky) { return annulus_otf(annulus, std::hypot(kx, ky)); },
            "annulus");
    }
}

TEST(Otf, AberratedPupilsMeetTheirOverlapIntegrals) {
    const auto &roman = std::get<RomanPupil>(Instrument::get("roman-c9").pupil(3, "H158"));
    auto segmented = std::get<SegmentedPupil>(Instrument::get("wfirst-afta-c5").pupil(7, "J129"));
    segmented.corner_radius = 0;
    struct Case {
        const char *name;
        std::shared_ptr<const Aperture> aperture;
        oracle::Regions regions;
    };
    for (const Case &c : {Case{"Roman", make_aperture(roman), {lit_region(roman)}},
                          Case{"C5", make_aperture(segmented), oracle::sharp_regions(segmented)}})
        for (const Wavefront &wavefront : {Wavefront({}, 1.18), aberrated()}) {
            const Component component{c.aperture, wavefront, wavelength, 1};
            for (const double eps : {1e-4, 1e-5}) {
                const Otf otf({&component, 1}, pixel_scale, false, eps);
                EXPECT_LE(otf.error_estimate(), eps);
                expect_within_estimates(
                    otf, 10,
                    [&](double kx, double ky) {
                        return oracle::autocorrelation(c.regions, wavefront, kx * wavelength,
                                                       ky * wavelength) /
                               c.aperture->area();
                    },
                    c.name);
            }
        }
}

TEST(Otf, IsOneAtZeroHermitianAndZeroBeyondTheCutOff) {
    const auto &roman = std::get<RomanPupil>(Instrument::get("roman-c9").pupil(3, "H158"));
    const Component component{make_aperture(roman), aberrated(), wavelength, 1};
    const Otf otf({&component, 1}, pixel_scale, true, 1e-3);
    EXPECT_EQ(otf.diffraction(0, 0), Complex(1));
    EXPECT_NEAR(otf.cutoff() * wavelength / component.aperture->diameter(), 1, 1e-9);
    for (const double f : {0.1, 0.33, 0.77}) {
        const double kx = f * otf.cutoff(), ky = (0.6 - f) * otf.cutoff();
        EXPECT_EQ(otf.diffraction(-kx, -ky), std::conj(otf.diffraction(kx, ky)));
        EXPECT_NE(otf.diffraction(kx, ky), Complex(0));
    }
    for (const double k : {1.0, 1.5, 1e9, 1e300, HUGE_VAL}) {
        EXPECT_EQ(otf.diffraction(k * otf.cutoff(), 0), Complex(0));
        EXPECT_EQ(otf.diffraction(0, -k * otf.cutoff()), Complex(0));
    }
}

// Against the plain Fourier sum of a large stamp: signs, frame, the pixel and none. What the stamp
// does not hold, a percent of the light, bounds the agreement.
TEST(Otf, IsTheTransformOfThePsf) {
    const auto &roman = std::get<RomanPupil>(Instrument::get("roman-c9").pupil(3, "H158"));
    struct Case {
        bool mirrored, pixel_response;
        Covariance blur;
    };
    const Covariance skew{0.1, -0.04, 0.05}, round{0.1, 0, 0.05};
    for (const auto &[mirrored, pixel_response, blur] :
         {Case{false, true, {}}, Case{true, true, skew}, Case{false, false, {}},
          Case{true, false, skew}, Case{false, false, round}}) {
        const Psf psf(make_aperture(roman), aberrated(),
                      {wavelength, pixel_scale, 1e-6, 48, mirrored, blur, pixel_response});
        const Otf otf(psf.components(), pixel_scale, mirrored, 1e-4, blur, pixel_response);
        constexpr int64_t n = 285, oversampling = 3;
        const double step = pixel_scale / oversampling;
        Plane<double> stamp(n, n);
        psf.draw({n / 2, n / 2, 1}, oversampling, stamp.view());
        for (const auto &[x, y] : {std::pair(0.2, 0.1), std::pair(0.1, -0.3), std::pair(-0.5, 0.2),
                                   std::pair(0.1, 0.6)}) {
            const double kx = x * otf.cutoff(), ky = y * otf.cutoff();
            Complex sum = 0;
            for (int64_t j = 0; j < n; ++j)
                for (int64_t i = 0; i < n; ++i)
                    sum += stamp(i, j) * std::polar(1.0, -2 * pi * step *
                                                             (kx * static_cast<double>(i - n / 2) +
                                                              ky * static_cast<double>(j - n / 2)));
            const Complex wanted = otf.effective(kx, ky);
            EXPECT_LT(std::abs(sum - wanted), 2e-3) << kx << ' ' << ky;
            EXPECT_GT(std::abs(wanted - std::conj(wanted)), mirrored ? 5e-3 : 0.01);
        }
    }
}

// A mask is its own raster: the exact autocorrelation of its squares, at any shift.
TEST(Otf, MaskOfSquaresIsExact) {
    constexpr int64_t nx = 6, ny = 4;
    const double scale = 0.3;
    Plane<double> mask(nx, ny);
    for (int64_t i = 0; i < nx * ny; ++i)
        mask(i % nx, i / nx) = 0.2 + 0.8 * std::abs(std::sin(static_cast<double>(7 * i + 1)));
    const Wavefront wavefront = aberrated();
    const Component component{make_aperture(mask.view(), scale, 2, 1.5), wavefront, wavelength, 1};
    const Otf otf({&component, 1}, pixel_scale, false, 1e-9);
    EXPECT_LT(otf.error_estimate(), 1e-12);
    EXPECT_LT(otf.value_error(), 1e-12);
    const auto field = [&](int64_t x, int64_t y) {
        return mask(x, y) * std::polar(1.0, 2 * pi *
                                                wavefront((static_cast<double>(x) - 2) * scale,
                                                          (static_cast<double>(y) - 1.5) * scale));
    };
    const auto shared = [](double shift) { return std::max(0.0, 1 - std::abs(shift)); };
    double squares = 0;
    for (int64_t i = 0; i < nx * ny; ++i)
        squares += std::norm(field(i % nx, i / nx));
    for (const auto &[x, y] : {std::pair(0.0, 0.0), std::pair(1.0, 2.0), std::pair(0.3, -0.8),
                               std::pair(-4.7, 2.2), std::pair(5.5, -3.6), std::pair(1.0, 4.0)}) {
        Complex sum = 0;
        for (int64_t a = 0; a < nx * ny; ++a)
            for (int64_t b = 0; b < nx * ny; ++b)
                sum += field(a % nx, a / nx) * std::conj(field(b % nx, b / nx)) *
                       shared(x - static_cast<double>(a % nx - b % nx)) *
                       shared(y - static_cast<double>(a / nx - b / nx));
        EXPECT_LT(std::abs(otf.diffraction(x * scale / wavelength, y * scale / wavelength) -
                           sum / squares),
                  1e-13)
            << x << ' ' << y;
    }
}

TEST(Otf, OfOneSquareIsATent) {
    Plane<double> mask(1, 1);
    mask(0, 0) = 0.5;
    const Component component{make_aperture(mask.view(), 0.7, 0, 0), aberrated(), wavelength, 1};
    const Otf otf({&component, 1}, pixel_scale, false, 1e-9);
    for (const auto &[x, y] :
         {std::pair(0.0, 0.0), std::pair(0.3, -0.8), std::pair(-0.9, -0.9), std::pair(1.2, 0.1)})
        EXPECT_LT(std::abs(otf.diffraction(x * 0.7 / wavelength, y * 0.7 / wavelength) -
                           std::max(0.0, 1 - std::abs(x)) * std::max(0.0, 1 - std::abs(y))),
                  1e-14);
}

TEST(Otf, OfSeveralComponentsIsTheirWeightedMean) {
    const AnnularPupil annulus = Instrument::get("wfirst-afta-c5").annular_pupil();
    const std::shared_ptr<const Aperture> aperture = make_aperture(annulus);
    const std::vector<Component> components{{aperture, Wavefront({}, 1.18), 1000e-9, 1},
                                            {aperture, aberrated(), 1500e-9, 3}};
    const Otf both(components, pixel_scale, false, 1e-4);
    const Otf first({components.data(), 1}, pixel_scale, false, 1e-5),
        second({&components[1], 1}, pixel_scale, false, 1e-5);
    EXPECT_DOUBLE_EQ(both.cutoff(), first.cutoff());
    for (const double f : {0.0, 0.2, 0.5, 0.8, 0.9}) {
        const double kx = f * first.cutoff(), ky = -f / 3 * first.cutoff();
        EXPECT_LT(std::abs(both.diffraction(kx, ky) - first.diffraction(kx, ky) / 4.0 -
                           second.diffraction(kx, ky) * 0.75),
                  both.value_error());
    }
}

} // namespace
} // namespace wfpsf
