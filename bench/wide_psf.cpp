// SPDX-License-Identifier: GPL-3.0-or-later
// PSFs of many colours and stamps of any size. Errors are the largest of the probed pixels against
// plain sums over pupil and wavelengths, or the obscured Airy pattern, in units of the peak pixel.
#include "harness.hpp"
#include "instrument/instrument.hpp"
#include "optics/psf.hpp"
#include "optics/roman_region.hpp"
#include "oracles/psf_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace wfpsf::bench {

namespace {

constexpr double pixel_scale = 0.11 * oracle::pi / 180 / 3600;

// Roman's detector 7.
struct Roman {
    const Instrument &instrument = Instrument::get("roman-c9");
    const RomanPupil &pupil;
    Optics optics;

    explicit Roman(const char *band)
        : pupil(std::get<RomanPupil>(instrument.pupil(7, band))), optics{make_aperture(pupil),
                                                                         wavefront(), 1293e-9} {}

    Wavefront wavefront() const {
        const auto zernikes = instrument.zernikes(7);
        std::vector<double> waves(zernikes.begin(), zernikes.end());
        std::fill_n(waves.begin(), 3, 0.0);
        return Wavefront(waves, 1.18);
    }
};

// A black body of 5000 K in a band, out to `radius` native pixels; with `count` sources that share
// their monochromatic images. Probed in the core and `far` pixels from there.
Case chromatic_case(const char *name, const char *band, double eps, double target_s, size_t count,
                    int64_t radius, int64_t far) {
    return {
        name, "largest pixel error / peak pixel", target_s, eps, [=] {
            const Roman roman(band);
            const Light light = detected_light(roman.instrument.band(band), black_body_sed(5000));
            const std::vector<Light> lights(count, light);
            const PsfSettings settings{.wavelength = 1293e-9,
                                       .pixel_scale = pixel_scale,
                                       .eps = eps,
                                       .radius = static_cast<double>(radius) + 0.5};
            Measured m;
            m.timing =
                time([&] { make_psfs(roman.optics, lights, settings); }, radius > 100 ? 1 : 3);
            const Psf psf = std::move(make_psfs(roman.optics, {&light, 1}, settings)[0]);
            const double star = static_cast<double>(radius) - 0.27;
            Plane<double> stamp(2 * radius, 2 * radius);
            psf.draw({star, star, 1}, 1, stamp.view());
            for (const int64_t at : {radius, radius - far}) {
                const double angle = (static_cast<double>(at) - star) * pixel_scale;
                const double farthest = std::numbers::sqrt2 * (std::abs(angle) + pixel_scale);
                const PupilNodes nodes = pupil_nodes(lit_cells(lit_region(roman.pupil)),
                                                     20 + 2 * oracle::pi * farthest / 850e-9, 1e-9);
                double truth = 0;
                const Spectrum spectrum = light(2.4 * farthest);
                for (size_t i = 0; i < spectrum.size(); ++i)
                    truth +=
                        spectrum.weight[i] *
                        oracle::brute_force_in_pixel(
                            nodes, roman.optics.wavefront.scaled(1293e-9 / spectrum.wavelength[i]),
                            spectrum.wavelength[i], angle, angle, pixel_scale, 7);
                m.error = std::max(m.error, std::abs(stamp(at, at) - truth) / psf.peak());
            }
            return m;
        }};
}

Case chromatic_stamp_case(const char *band, double eps, double target_s, size_t count) {
    char name[80];
    std::snprintf(name, sizeof name,
                  "chromatic PSF, Roman %s, +-16 native pixels, %zu SED, eps %.0e", band, count,
                  eps);
    return chromatic_case(name, band, eps, target_s, count, 16, 16);
}

// The annulus, because its wings have a closed form; a pupil with struts takes the same time.
Case large_case(int64_t n, double eps) {
    char name[80];
    std::snprintf(name, sizeof name, "stamp %lld^2 of a bright star, J129, eps %.0e",
                  static_cast<long long>(n), eps);
    return {
        name, "largest pixel error / peak pixel", 0, eps, [=] {
            const AnnularPupil pupil = Instrument::get("wfirst-afta-c5").annular_pupil();
            const double wavelength = 1292.11e-9;
            const Psf psf(make_aperture(pupil), Wavefront({}, 1.18),
                          {wavelength, pixel_scale, eps, 8});
            const double star = static_cast<double>(n / 2) + 0.23;
            Plane<double> image(n, n);
            Measured m;
            m.timing = time([&] { psf.draw({star, star, 1}, 1, image.view()); }, n > 1024 ? 1 : 3);
            const oracle::Intensity truth = oracle::airy(pupil, wavelength);
            for (const auto &[x, y] : {std::pair(n / 2, n / 2), std::pair(n / 2 + 45, n / 2),
                                       std::pair(n / 2 + 100, n / 2 - 93),
                                       std::pair(int64_t{0}, n - 1), std::pair(n - 1, n / 3)}) {
                const double expected =
                    oracle::in_pixel(truth, (static_cast<double>(x) - star) * pixel_scale,
                                     (static_cast<double>(y) - star) * pixel_scale, pixel_scale);
                m.error = std::max(m.error, std::abs(image(x, y) - expected) / psf.peak());
            }
            return m;
        }};
}

} // namespace

std::vector<Case> wide_psf_cases() {
    return {chromatic_stamp_case("J129", 1e-3, 0, 1),
            chromatic_stamp_case("J129", 1e-4, 0, 1),
            chromatic_stamp_case("J129", 1e-5, 30e-3, 1),
            chromatic_stamp_case("J129", 1e-6, 0, 1),
            chromatic_stamp_case("J129", 1e-7, 0, 1),
            chromatic_stamp_case("J129", 1e-5, 0, 10),
            chromatic_stamp_case("W146", 1e-3, 0, 1),
            chromatic_stamp_case("W146", 1e-5, 80e-3, 1),
            chromatic_stamp_case("W146", 1e-7, 0, 1),
            chromatic_case("chromatic field, Roman J129, +-256 native pixels, eps 1e-06", "J129",
                           1e-6, 0, 1, 256, 32),
            large_case(512, 1e-8),
            large_case(1024, 1e-8),
            large_case(4096, 1e-8)};
}

} // namespace wfpsf::bench
