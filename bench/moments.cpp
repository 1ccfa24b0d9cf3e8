// SPDX-License-Identifier: GPL-3.0-or-later
// Adaptive moments and EE50 of an obscured Airy pattern averaged over the native pixel. Errors are
// against the same star sampled at another rate and measured to the last digit: both sample a
// band-limited image finely enough to agree to rounding.
#include "harness.hpp"
#include "instrument/instrument.hpp"
#include "moments/adaptive.hpp"
#include "moments/encircled.hpp"
#include "optics/psf.hpp"

#include <cmath>
#include <numbers>

namespace wfpsf::bench {

namespace {

constexpr double pixel_scale = 0.11 * std::numbers::pi / 180 / 3600;

// A star of J129 on n^2 samples, N a native pixel, 0.3 samples off the centre.
Plane<double> star(int64_t n, int64_t N) {
    const double wavelength = 1292.11e-9;
    const Psf psf(make_aperture(Instrument::get("wfirst-afta-c5").annular_pupil()),
                  Wavefront({}, 1.18), {wavelength, pixel_scale, 1e-11, 16});
    Plane<double> image(n, n);
    const double centre = static_cast<double>(n - 1) / 2 + 0.3;
    psf.draw({centre, centre, 1}, N, image.view());
    return image;
}

Gaussian guess(int64_t n, int64_t N) {
    const double size = 0.6 * static_cast<double>(N);
    return {.x = static_cast<double>(n - 1) / 2,
            .y = static_cast<double>(n - 1) / 2,
            .Mxx = size * size,
            .Mxy = 0,
            .Myy = size * size};
}

double native_sigma(const Plane<double> &image, int64_t N, double tolerance) {
    return adaptive_moments(image.view(), guess(image.nx(), N), {.tolerance = tolerance}).sigma() /
           static_cast<double>(N);
}

Case adaptive_case(int64_t n, int64_t N, double target_s) {
    char name[64];
    std::snprintf(name, sizeof name, "adaptive moments %lld^2 (N = %lld), tolerance 1e-8",
                  static_cast<long long>(n), static_cast<long long>(N));
    return {name, "relative error of sigma", target_s, 1e-8, [=] {
                const Plane<double> image = star(n, N);
                const double truth = native_sigma(star(24 * 20, 20), 20, 1e-12);
                Measured m;
                m.timing =
                    time([&] { adaptive_moments(image.view(), guess(n, N), {.tolerance = 1e-8}); });
                m.error = std::abs(native_sigma(image, N, 1e-8) / truth - 1);
                return m;
            }};
}

Case ee50_case() {
    return {"EE50 512^2 (N = 32), integral of the image", "relative error", 0, 1e-9, [] {
                const auto ee50 = [](const Plane<double> &image, int64_t N) {
                    const double centre = static_cast<double>(image.nx() - 1) / 2 + 0.3;
                    return encircled_radius(image.view(), centre, centre, 0.5, 1).radius /
                           static_cast<double>(N);
                };
                const Plane<double> image = star(512, 32);
                Measured m;
                m.timing = time([&] { ee50(image, 32); });
                m.error = std::abs(ee50(image, 32) / ee50(star(24 * 20, 20), 20) - 1);
                return m;
            }};
}

} // namespace

std::vector<Case> moments_cases() {
    return {adaptive_case(32, 4, 12e-6), adaptive_case(128, 8, 15e-6),
            adaptive_case(512, 32, 60e-6), ee50_case()};
}

} // namespace wfpsf::bench
