// SPDX-License-Identifier: GPL-3.0-or-later
// PSFs: model, stamps, the paper's image. Errors are the largest of all probed pixels against a
// plain sum over a far finer quadrature, in units of the peak pixel.
#include "optics/psf.hpp"

#include "harness.hpp"
#include "instrument/instrument.hpp"
#include "optics/roman_region.hpp"
#include "oracles/psf_oracle.hpp"

#include <algorithm>
#include <optional>

namespace wfpsf::bench {

namespace {

constexpr double pixel_scale = 0.11 * oracle::pi / 180 / 3600;
constexpr double wavelength = 1292.11e-9; // J129
constexpr double radius = 16.5;

const Instrument &c5() {
    return Instrument::get("wfirst-afta-c5");
}

const SegmentedPupil &c5_pupil() {
    return std::get<SegmentedPupil>(c5().pupil(7, "J129"));
}

Wavefront detector7(const Instrument &instrument, double at) {
    const auto zernikes = instrument.zernikes(7);
    std::vector<double> waves(zernikes.begin(), zernikes.end());
    std::fill_n(waves.begin(), 3, 0.0);
    for (double &a : waves)
        a *= 1293e-9 / at;
    return Wavefront(waves, 1.18);
}

Wavefront sca7() {
    return detector7(c5(), wavelength);
}

const oracle::Intensity &c5_truth() {
    static const oracle::Intensity truth =
        oracle::brute_force(pupil_nodes(c5_pupil(), 120, 1e-14), sca7(), wavelength);
    return truth;
}

Psf make_psf(double eps, double reach = radius) {
    return Psf(make_aperture(c5_pupil()), sca7(), {wavelength, pixel_scale, eps, reach});
}

// Draws an image of n^2 samples with the star a little off its centre; the largest error over
// probes from the core to the corners.
double draw_error(const Psf &psf, const oracle::Intensity &truth, int64_t n, int64_t oversampling) {
    const double star = static_cast<double>(n - 1) / 2 + 0.23;
    Plane<double> image(n, n);
    psf.draw({star, star, 1}, oversampling, image.view());
    const auto scale = static_cast<double>(oversampling);
    double peak = 0, worst = 0;
    for (int64_t y = 0; y < n; ++y)
        for (int64_t x = 0; x < n; ++x)
            peak = std::max(peak, image(x, y));
    for (const auto &[x, y] : {std::pair(n / 2, n / 2), std::pair(n / 2 + oversampling, n / 2),
                               std::pair(int64_t{0}, n - 1), std::pair(n - 1, n / 3)}) {
        const double expected =
            oracle::in_pixel(truth, (static_cast<double>(x) - star) * pixel_scale / scale,
                             (static_cast<double>(y) - star) * pixel_scale / scale, pixel_scale) /
            (scale * scale);
        worst = std::max(worst, std::abs(image(x, y) - expected) / peak);
    }
    return worst;
}

Case model_case(double eps, double target_s) {
    char name[64];
    std::snprintf(name, sizeof name, "PSF model, J129, +-16 native pixels, eps %.0e", eps);
    return {name, "largest pixel error / peak pixel", target_s, eps, [eps] {
                Measured m;
                m.timing = time([eps] { make_psf(eps); });
                m.error = draw_error(make_psf(eps), c5_truth(), 32, 1);
                return m;
            }};
}

// Roman's detector 7.
Case roman_case(const char *band, double band_wavelength) {
    char name[64];
    std::snprintf(name, sizeof name, "PSF model, Roman %s, the same, eps 1e-06", band);
    return {name, "largest pixel error / peak pixel", 0, 1e-6, [=] {
                const Instrument &roman = Instrument::get("roman-c9");
                const auto &pupil = std::get<RomanPupil>(roman.pupil(7, band));
                const Wavefront wavefront = detector7(roman, band_wavelength);
                const std::shared_ptr<const Aperture> aperture = make_aperture(pupil);
                const auto make = [&] {
                    return Psf(aperture, wavefront, {band_wavelength, pixel_scale, 1e-6, radius});
                };
                Measured m;
                m.timing = time(make);
                const oracle::Intensity truth =
                    oracle::brute_force(pupil_nodes(lit_cells(lit_region(pupil)), 120, 1e-14),
                                        wavefront, band_wavelength);
                m.error = draw_error(make(), truth, 32, 1);
                return m;
            }};
}

// The pupil as a mask of its lit fractions; the error is that of pixels in place of edges.
Case mask_case(int64_t n) {
    char name[64];
    std::snprintf(name, sizeof name, "PSF model, mask of %lld^2, the same, eps 1e-06",
                  static_cast<long long>(n));
    return {name, "largest pixel error / peak pixel", 0, 0, [n] {
                const PupilRaster drawn = make_aperture(c5_pupil())->raster(n, n);
                const auto make = [&] {
                    return Psf(
                        make_aperture(drawn.lit.view(), drawn.scale, drawn.axis_x, drawn.axis_y),
                        sca7(), {wavelength, pixel_scale, 1e-6, radius});
                };
                Measured m;
                m.timing = time(make);
                m.error = draw_error(make(), c5_truth(), 32, 1);
                return m;
            }};
}

Case draw_case(const std::string &name, double eps, int64_t n, int64_t oversampling,
               double target_s, bool with_model) {
    return {name, "largest pixel error / peak pixel", target_s, eps, [=] {
                Plane<double> image(n, n);
                const double star = static_cast<double>(n - 1) / 2 + 0.23;
                const double reach = static_cast<double>(n) / static_cast<double>(2 * oversampling);
                const Psf psf = make_psf(eps, reach + 0.5);
                Measured m;
                m.timing = time([&] {
                    std::optional<Psf> fresh;
                    if (with_model)
                        fresh = make_psf(eps, reach + 0.5);
                    (fresh ? *fresh : psf).draw({star, star, 1}, oversampling, image.view());
                });
                m.error = draw_error(psf, c5_truth(), n, oversampling);
                return m;
            }};
}

Case stamp_case(double eps, double target_s) {
    char name[64];
    std::snprintf(name, sizeof name, "star stamp 32^2, model built, eps %.0e", eps);
    return draw_case(name, eps, 32, 1, target_s, false);
}

// Stars all over a detector, each +-16 native pixels; the error is that of one of them by itself.
Case stars_case(const char *name, int64_t count, int threads) {
    return {name, "largest pixel error / peak pixel", 0, 1e-5, [=] {
                const int64_t n = 4088;
                std::vector<Star> stars;
                for (int64_t i = 0; i < count; ++i) // a golden-ratio lattice
                    stars.push_back({std::fmod(static_cast<double>(i) * 0.6180339887, 1.0) * n,
                                     static_cast<double>(i * n) / static_cast<double>(count), 1});
                Plane<double> image(n, n);
                const Psf psf = make_psf(1e-5);
                Measured m;
                m.timing = time([&] { psf.add(stars, 1, image.view(), threads); });
                m.error = draw_error(psf, c5_truth(), 32, 1);
                return m;
            }};
}

} // namespace

std::vector<Case> psf_cases() {
    return {model_case(1e-2, 0),
            model_case(1e-3, 0),
            model_case(1e-4, 0),
            model_case(1e-5, 0),
            model_case(1e-6, 2.5e-3),
            model_case(1e-7, 0),
            model_case(1e-8, 0),
            model_case(1e-9, 0),
            model_case(1e-10, 5e-3),
            roman_case("J129", 1292.11e-9),
            roman_case("F184", 1837.3e-9),
            mask_case(512),
            mask_case(1024),
            mask_case(4096),
            stamp_case(1e-3, 0),
            stamp_case(1e-5, 5e-6),
            stamp_case(1e-7, 0),
            stamp_case(1e-9, 0),
            draw_case("effective PSF 512^2 at pixel/32 with its model, eps 1e-6", 1e-6, 512, 32,
                      10e-3, true),
            stars_case("1e4 stars on 4088^2, +-16 native pixels, eps 1e-5", 10000, 1),
            stars_case("1e4 stars on 4088^2, the same, 2 threads", 10000, 2)};
}

} // namespace wfpsf::bench
