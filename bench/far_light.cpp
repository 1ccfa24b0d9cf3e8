// SPDX-License-Identifier: GPL-3.0-or-later
// Light of a bright star far from the core, by the pupil's edges. Errors against the exact engine,
// which a tilt of the wavefront takes to a spike 128 native pixels off.
#include "optics/far_light.hpp"

#include "harness.hpp"
#include "instrument/instrument.hpp"
#include "optics/psf.hpp"
#include "oracles/tilted_star.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace wfpsf::bench {

namespace {

const PsfSettings settings{.wavelength = oracle::reference_wavelength,
                           .pixel_scale = oracle::native_pixel,
                           .eps = 1e-5,
                           .radius = 10.5};

// The largest error on the brightest spike, as a share of its brightest pixel there.
double spike_error(const oracle::TiltedStar &source, const FarLight &far) {
    const auto spikes = far.spikes(128, 1e-30);
    const auto [x, y] = [&] {
        double most = 0, best_x = 0, best_y = 0;
        for (const auto &spike : spikes) {
            const double px = std::round(128 * spike.x), py = std::round(128 * spike.y);
            if (const double light = far.at(px, py); light > most) {
                most = light;
                best_x = px;
                best_y = py;
            }
        }
        return std::pair(best_x, best_y);
    }();
    const Psf psf = std::move(make_psfs(source.optics(x, y), {&source.light, 1}, settings)[0]);
    Plane<double> stamp(21, 21);
    psf.draw({10, 10, 1}, 1, stamp.view());
    double most = 0, worst = 0;
    for (int64_t j = 0; j < 21; ++j)
        for (int64_t i = 0; i < 21; ++i) {
            most = std::max(most, stamp(i, j));
            worst = std::max(worst, std::abs(far.at(x + static_cast<double>(i - 10),
                                                    y + static_cast<double>(j - 10)) -
                                             stamp(i, j)));
        }
    return worst / most;
}

constexpr double flux = 1e8; // electrons

Case making_case(const char *name, const char *band) {
    char title[80];
    std::snprintf(title, sizeof title, "far light of a star made, %s %s", name, band);
    return {title, "largest error on a spike 128 pixels off / its peak there", 0, 0, [=] {
                const oracle::TiltedStar source(name, band);
                const Optics optics = source.optics(0, 0);
                const FarLight far(optics, source.light, settings);
                Measured m;
                m.timing = time([&] { FarLight(optics, source.light, settings); });
                m.error = spike_error(source, far);
                return m;
            }};
}

Case drawing_case(const char *name, const char *band, double floor) {
    char title[96];
    std::snprintf(title, sizeof title, "far light, 4088^2, %s %s, 1e8 e, floor %g e", name, band,
                  floor);
    return {title, "largest light left out beyond 64 pixels, e", 0, 0, [=] {
                const oracle::TiltedStar source(name, band);
                const FarLight far(source.optics(0, 0), source.light, settings);
                const Star star{2043.3, 2043.7, flux};
                Plane<float> image(4088, 4088), all(4088, 4088);
                Measured m;
                m.timing = time([&] { far.add(star, 64, floor, image.view()); }, 1);
                image = Plane<float>(4088, 4088);
                far.add(star, 64, floor, image.view());
                far.add(star, 64, 1e-12, all.view());
                for (int64_t y = 0; y < 4088; ++y)
                    for (int64_t x = 0; x < 4088; ++x)
                        m.error = std::max(m.error, std::abs(static_cast<double>(all(x, y)) -
                                                             static_cast<double>(image(x, y))));
                return m;
            }};
}

} // namespace

std::vector<Case> far_light_cases() {
    return {making_case("roman-c9", "J129"),        making_case("wfirst-afta-c5", "J129"),
            making_case("wfirst-afta-c5", "F184"),  drawing_case("roman-c9", "J129", 1e-12),
            drawing_case("roman-c9", "J129", 0.01), drawing_case("roman-c9", "J129", 0.05)};
}

} // namespace wfpsf::bench
