// SPDX-License-Identifier: GPL-3.0-or-later
// World coordinates of a detector, both ways, against wcslib with the same header; a million
// positions all over it. Errors are in pixels: against wcslib on the sky, and there and back.
#include "observation/observation.hpp"

#include "harness.hpp"
#include "oracles/wcs_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace wfpsf::bench {

namespace {

constexpr int64_t count = 1000000;

struct Positions {
    Positions() : x(count), y(count), ra(count), dec(count), pixels(2 * count), world(2 * count) {
        std::mt19937 random(1);
        std::uniform_real_distribution<double> place(-0.5, 4087.5);
        for (size_t i = 0; i < x.size(); ++i) {
            x[i] = place(random);
            y[i] = place(random);
            pixels[2 * i] = x[i] + 1;
            pixels[2 * i + 1] = y[i] + 1;
        }
        observation.wcs(sca).to_sky(count, x.data(), y.data(), ra.data(), dec.data());
        for (size_t i = 0; i < x.size(); ++i) {
            world[2 * i] = ra[i];
            world[2 * i + 1] = dec[i];
        }
    }

    static constexpr int sca = 7;
    Observation observation{Instrument::get("roman-c9"), {53.1, -27.8}, 30, {}};
    std::vector<double> x, y, ra, dec, pixels, world; // pixels and world for wcslib
};

Measured to_sky() {
    const Positions at;
    const TanSip &wcs = at.observation.wcs(at.sca);
    WcsOracle oracle(fits_header(at.observation, at.sca));
    std::vector<double> ra(count), dec(count), theirs;
    Measured m;
    m.timing = time([&] { wcs.to_sky(count, at.x.data(), at.y.data(), ra.data(), dec.data()); });
    m.baseline = "wcslib";
    m.baseline_s = time([&] { theirs = oracle.to_sky(at.pixels); }).median_s;
    for (size_t i = 0; i < ra.size(); ++i) {
        const double east =
            std::remainder(ra[i] - theirs[2 * i], 360) * std::cos(dec[i] * std::numbers::pi / 180);
        m.error = std::max(m.error, std::hypot(east, dec[i] - theirs[2 * i + 1]) * 3600 / 0.11);
    }
    return m;
}

Measured to_pixel() {
    const Positions at;
    const TanSip &wcs = at.observation.wcs(at.sca);
    WcsOracle oracle(fits_header(at.observation, at.sca));
    std::vector<double> x(count), y(count), theirs;
    Measured m;
    m.timing = time([&] { wcs.to_pixel(count, at.ra.data(), at.dec.data(), x.data(), y.data()); });
    m.baseline = "wcslib";
    m.baseline_s = time([&] { theirs = oracle.to_pixel(at.world); }).median_s;
    for (size_t i = 0; i < x.size(); ++i)
        m.error = std::max(m.error, std::hypot(x[i] - at.x[i], y[i] - at.y[i]));
    return m;
}

Measured find() {
    const Positions at;
    std::vector<int32_t> sca(count);
    std::vector<double> x(count), y(count);
    Measured m;
    m.timing = time([&] {
        at.observation.find(false, count, at.ra.data(), at.dec.data(), sca.data(), x.data(),
                            y.data());
    });
    for (size_t i = 0; i < x.size(); ++i)
        m.error = std::max(m.error, sca[i] == at.sca ? std::hypot(x[i] - at.x[i], y[i] - at.y[i])
                                                     : INFINITY);
    return m;
}

} // namespace

std::vector<Case> observation_cases() {
    return {{"WCS, 1e6 pixels to the sky", "pixels, against wcslib", 0, 1e-7, to_sky},
            {"WCS, 1e6 places on the sky to pixels", "pixels, there and back", 0, 1e-7, to_pixel},
            {"WCS, the detectors of 1e6 places", "pixels, there and back", 0, 1e-7, find}};
}

} // namespace wfpsf::bench
