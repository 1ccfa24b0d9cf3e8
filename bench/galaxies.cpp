// SPDX-License-Identifier: GPL-3.0-or-later
// Galaxies behind Roman's PSF: the time of one more, and the largest error of any pixel in
// electrons. Small ones are held against many stars, large ones against a tolerance a hundred times
// tighter, which has other transforms.
#include "harness.hpp"
#include "instrument/instrument.hpp"
#include "optics/psf.hpp"
#include "oracles/galaxy_oracle.hpp"
#include "scene/galaxy.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace wfpsf::bench {

namespace {

constexpr double pixel_arcsec = 0.11, pixel = pixel_arcsec * std::numbers::pi / 180 / 3600;
const Covariance blur{0.02, 0, 0.02};

Psf make_psf() {
    const Wavefront wavefront(std::vector<double>{0, 0, 0, 0.05, -0.03, 0.02, 0.02, -0.03}, 1.18);
    return {make_aperture(std::get<RomanPupil>(Instrument::get("roman-c9").pupil(3, "H158"))),
            wavefront,
            {1577e-9, pixel, 1e-6, 64, true, blur, true}};
}

Otf make_otf(const Psf &psf) {
    return {psf.components(), pixel, true, 1e-4, blur, true};
}

double difference(const Plane<double> &a, const Plane<double> &b) {
    double most = 0;
    for (int64_t y = 0; y < a.ny(); ++y)
        for (int64_t x = 0; x < a.nx(); ++x)
            most = std::max(most, std::abs(a(x, y) - b(x, y)));
    return most;
}

Plane<double> of_stars(const Psf &psf, const Galaxy &g, int64_t size) {
    const oracle::SersicGalaxy galaxy{g.sersic_index, Sersic(g.sersic_index).b(),
                                      g.half_light_radius / pixel_arcsec, g.e1, g.e2};
    std::vector<Star> stars;
    oracle::for_each_node(galaxy, 1.2, 12 * galaxy.radius, [&](double x, double y, double light) {
        stars.push_back({g.x + x, g.y + y, g.flux * light});
    });
    Plane<double> image(size, size);
    psf.add<double>(stars, 1, image.view(), 1);
    return image;
}

Measured galaxy(double index, double arcsec, double flux, double tolerance, int64_t size,
                bool against_stars) {
    const Psf psf = make_psf();
    const Otf otf = make_otf(psf);
    SersicProfiles profiles;
    GalaxyDrawer drawer(transfer_of(otf, pixel), pixel_arcsec, profiles);
    const double centre = static_cast<double>(size) / 2;
    const Galaxy g{centre - 0.3, centre + 0.2, flux, index, arcsec, 0.2, 0.1};
    Plane<double> image(size, size), truth(size, size);
    drawer.add(g, tolerance, image.view());
    if (against_stars)
        truth = of_stars(psf, g, size);
    else
        drawer.add(g, tolerance / 100, truth.view());
    Measured m;
    m.error = difference(image, truth);
    m.timing = time([&] { drawer.add(g, tolerance, image.view()); });
    m.baseline = "a star's stamp of 32^2";
    Plane<double> stamp(32, 32);
    m.baseline_s = time([&] { psf.draw({15.7, 16.2, flux}, 1, stamp.view()); }).median_s;
    return m;
}

Measured first_galaxy() {
    const Psf psf = make_psf();
    const Otf otf = make_otf(psf);
    SersicProfiles profiles;
    profiles.of(1);
    profiles.of(0.5);
    Plane<double> image(64, 64);
    Measured m;
    m.timing = time([&] {
        GalaxyDrawer drawer(transfer_of(otf, pixel), pixel_arcsec, profiles);
        drawer.add({31.7, 32.2, 1e3, 1, 0.3, 0.2, 0.1}, 0.1, image.view());
    });
    m.error = NAN;
    m.baseline = "making the OTF";
    m.baseline_s = time([&] { make_otf(psf); }).median_s;
    return m;
}

Measured profile() {
    Measured m;
    m.timing = time([] { Sersic(1); });
    const Sersic s(1);
    for (double k = 1e-6; k < 1e6; k *= 1.01)
        m.error =
            std::max(m.error, std::abs(s.transform(k) - std::pow(1 + k * k / s.b() / s.b(), -1.5)));
    return m;
}

} // namespace

std::vector<Case> galaxy_cases() {
    const auto small = [](double n, double arcsec, double flux, double tolerance) {
        return [=] { return galaxy(n, arcsec, flux, tolerance, 64, true); };
    };
    const auto large = [](double n, double arcsec, double flux, double tolerance, int64_t size) {
        return [=] { return galaxy(n, arcsec, flux, tolerance, size, false); };
    };
    return {
        {"galaxy, n = 1, 0.3 arcsec, 1e3 e-, to 0.1 e-", "pixel, e-", 3e-4, 0.1,
         small(1, 0.3, 1e3, 0.1)},
        {"galaxy, n = 1, 0.3 arcsec, 1e3 e-, to 1 e-", "pixel, e-", 3e-4, 1, small(1, 0.3, 1e3, 1)},
        {"galaxy, n = 1, 0.3 arcsec, 1e5 e-, to 1 e-", "pixel, e-", 0, 1, small(1, 0.3, 1e5, 1)},
        {"galaxy, n = 4, 0.3 arcsec, 1e4 e-, to 0.1 e-", "pixel, e-", 0, 0.1,
         small(4, 0.3, 1e4, 0.1)},
        {"galaxy, n = 4, 1 arcsec, 1e5 e-, to 1 e-, 512^2", "pixel, e-", 0, 1,
         large(4, 1, 1e5, 1, 512)},
        {"galaxy, n = 1, 11 arcsec, 1e6 e-, to 0.1 e-, 1024^2", "pixel, e-", 0, 0.1,
         large(1, 11, 1e6, 0.1, 1024)},
        {"galaxy, n = 4, 110 arcsec, 1e8 e-, to 1 e-, 4088^2", "pixel, e-", 0, 1,
         large(4, 110, 1e8, 1, 4088)},
        {"galaxy, the first one behind a PSF", "", 0, 0, first_galaxy},
        {"galaxy, the table of a profile", "transform", 0, 1e-9, profile}};
}

} // namespace wfpsf::bench
