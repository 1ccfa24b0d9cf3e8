// SPDX-License-Identifier: GPL-3.0-or-later
// The PSF over a detector: what a model of it costs, and what the ways around it err by. Errors are
// the largest of any pixel at a few places all over the detector, against exact PSFs of wavefronts
// that meet all five field points, in units of the peak pixel.
#include "optics/varying_psf.hpp"

#include "harness.hpp"
#include "instrument/instrument.hpp"
#include "oracles/psf_oracle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <span>

namespace wfpsf::bench {

namespace {

constexpr double wavelength = 1293e-9, last_pixel = 4087;
constexpr int64_t size = 15;

struct Place {
    double x, y;
};

// A star at the centre of a stamp, seen at a place.
using Stamp = std::function<Plane<double>(const Place &)>;

struct Detector {
    const Instrument &roman = Instrument::get("roman-c9");
    std::shared_ptr<const Aperture> aperture =
        make_aperture(std::get<RomanPupil>(roman.pupil(7, "J129")));
    PsfSettings settings(double eps) const {
        return {.wavelength = wavelength,
                .pixel_scale = 0.11 * oracle::pi / 180 / 3600,
                .eps = eps,
                .radius = 8};
    }
    Optics optics(const Place &at, FieldRule rule = FieldRule::five_points) const {
        std::vector<double> zernikes = roman.zernikes(7, at.x, at.y, rule);
        std::fill_n(zernikes.begin(), 3, 0.0);
        return {aperture, Wavefront(zernikes, 1.18), wavelength};
    }
    Psf exact(const Place &at, double eps = 1e-9, FieldRule rule = FieldRule::five_points) const {
        return Psf(aperture, optics(at, rule).wavefront, settings(eps));
    }
};

Plane<double> drawn(const Psf &psf) {
    Plane<double> stamp(size, size);
    psf.draw({7.2, 6.9, 1}, 1, stamp.view());
    return stamp;
}

double worst_error(const Detector &detector, const Stamp &stamp) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> inside(0, last_pixel);
    double worst = 0;
    for (int i = 0; i < 24; ++i) {
        const Place at{inside(random), inside(random)};
        const Plane<double> truth = drawn(detector.exact(at)), got = stamp(at);
        double peak = 0, error = 0;
        for (int64_t y = 0; y < size; ++y)
            for (int64_t x = 0; x < size; ++x) {
                peak = std::max(peak, truth(x, y));
                error = std::max(error, std::abs(got(x, y) - truth(x, y)));
            }
        worst = std::max(worst, error / peak);
    }
    return worst;
}

// The time is that of one place, once what is held was made.
Case place_case(const char *name, double eps, const std::function<Stamp(const Detector &)> &make) {
    return {name, "largest pixel error / peak pixel", 0, eps, [=] {
                const Detector detector;
                const Stamp stamp = make(detector);
                Measured m;
                m.timing = time([&] { stamp({1234, 3210}); });
                m.error = worst_error(detector, stamp);
                return m;
            }};
}

VaryingPsf model(const Detector &detector, double eps, double radius = 8) {
    PsfSettings settings = detector.settings(eps);
    settings.radius = radius;
    return {[&detector](double x, double y) {
                return detector.optics({x, y});
            },
            true,
            monochromatic(wavelength),
            settings,
            {0, 0, last_pixel, last_pixel}};
}

Case built_case(double eps) {
    char name[80];
    std::snprintf(name, sizeof name, "PSF all over SCA 7, Roman J129, the model made, eps %.0e",
                  eps);
    return {name, "largest pixel error / peak pixel", 0, eps, [eps] {
                const Detector detector;
                Measured m;
                m.timing = time([&] { model(detector, eps); });
                const VaryingPsf varying = model(detector, eps);
                m.error = worst_error(
                    detector, [&](const Place &at) { return drawn(varying.at(at.x, at.y)); });
                return m;
            }};
}

Stamp from_model(const Detector &detector) {
    return [varying = model(detector, 1e-5)](const Place &at) {
        return drawn(varying.at(at.x, at.y));
    };
}

Stamp exactly(const Detector &detector) {
    return [&detector](const Place &at) { return drawn(detector.exact(at, 1e-5)); };
}

Stamp by_corner_rule(const Detector &detector) {
    return [&detector](const Place &at) {
        return drawn(detector.exact(at, 1e-5, FieldRule::corners));
    };
}

// The time is that of one of many stars of one flux, all over the detector, that may lack
// `left_out` of their light in a pixel; the error is that of some that stand apart.
Case stars_case(double radius, double left_out, size_t count) {
    char name[100];
    std::snprintf(name, sizeof name, "Star of %zu all over SCA 7, radius %g, leaving out %.1e",
                  count, radius, left_out);
    return {
        name, "largest pixel error / flux", 0, left_out, [=] {
            const Detector detector;
            const VaryingPsf varying = model(detector, 3e-5, radius);
            const std::vector<StarDetail> details(count, {radius, left_out});
            std::mt19937 random(5);
            std::uniform_real_distribution<double> inside(0, last_pixel), offset(-0.5, 0.5);
            std::vector<Star> stars, apart;
            for (size_t i = 0; i < count; ++i)
                stars.push_back({inside(random), inside(random), 1});
            Plane<float> image(4088, 4088);
            const auto draw = [&](const std::vector<Star> &these) {
                varying.add(std::span(these), std::span(details).first(these.size()), 0, 0, 1,
                            image.view(), 1);
            };
            Measured m;
            m.timing = time([&] { draw(stars); });
            m.timing.median_s /= static_cast<double>(count);
            m.timing.min_s /= static_cast<double>(count);
            const auto half = static_cast<int64_t>(radius), step = 2 * half + 3;
            for (int64_t y = step; y < 4088 - step; y += step)
                for (int64_t x = step; x < 4088 - step; x += step)
                    apart.push_back({static_cast<double>(x) + offset(random),
                                     static_cast<double>(y) + offset(random), 1});
            apart.resize(std::min(apart.size(), count));
            image = Plane<float>(4088, 4088);
            draw(apart);
            for (size_t i = 0; i < apart.size(); i += 1 + apart.size() / 100) {
                const Star &star = apart[i];
                const int64_t x0 = std::lround(star.x) - half + 1;
                const int64_t y0 = std::lround(star.y) - half + 1;
                Plane<double> truth(2 * half - 1, 2 * half - 1);
                varying.at(star.x, star.y)
                    .draw({star.x - static_cast<double>(x0), star.y - static_cast<double>(y0), 1},
                          1, truth.view());
                for (int64_t y = 0; y < truth.ny(); ++y)
                    for (int64_t x = 0; x < truth.nx(); ++x)
                        m.error =
                            std::max(m.error, std::abs(static_cast<double>(image(x0 + x, y0 + y)) -
                                                       truth(x, y)));
            }
            return m;
        }};
}

// The PSFs of the corners, weighted by the place's distances from them.
Stamp between_corner_psfs(const Detector &detector) {
    std::array<Plane<double>, 4> corners;
    for (size_t i = 0; i < 4; ++i)
        corners[i] = drawn(detector.exact({i % 2 ? last_pixel : 0, i / 2 ? last_pixel : 0}));
    return [corners](const Place &at) {
        const double u = at.x / last_pixel, v = at.y / last_pixel;
        Plane<double> sum(size, size);
        for (size_t i = 0; i < 4; ++i)
            for (int64_t y = 0; y < size; ++y)
                for (int64_t x = 0; x < size; ++x)
                    sum(x, y) += (i % 2 ? u : 1 - u) * (i / 2 ? v : 1 - v) * corners[i](x, y);
        return sum;
    };
}

Stamp of_the_centre(const Detector &detector) {
    return [stamp = drawn(detector.exact({last_pixel / 2, last_pixel / 2}))](const Place &) {
        return stamp;
    };
}

} // namespace

std::vector<Case> varying_psf_cases() {
    return {built_case(1e-3),
            built_case(1e-5),
            place_case("PSF at a place: from that model, eps 1e-05", 1e-5, from_model),
            place_case("PSF at a place: made for it, eps 1e-05", 1e-5, exactly),
            place_case("PSF at a place: aberrations bilinear between corners", 0, by_corner_rule),
            place_case("PSF at a place: PSFs bilinear between corners", 0, between_corner_psfs),
            place_case("PSF at a place: that of the centre", 0, of_the_centre),
            stars_case(15, 6e-5, 50000),
            stars_case(22, 6e-5, 30000),
            stars_case(48, 1.5e-5, 10000),
            stars_case(15, 1e-6, 10000)};
}

} // namespace wfpsf::bench
