// SPDX-License-Identifier: GPL-3.0-or-later
// Stamps beyond the field made in advance: in strips, far out in the wings, with little memory.
#include "error/error.hpp"
#include "instrument/instrument.hpp"
#include "optics/psf.hpp"
#include "oracles/psf_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace wfpsf {
namespace {

using namespace oracle;

constexpr double arcsec = pi / 180 / 3600, pixel_scale = 0.11 * arcsec;
constexpr double wavelength = 1292.11e-9;

const SegmentedPupil &c5_pupil() {
    return std::get<SegmentedPupil>(Instrument::get("wfirst-afta-c5").pupil(7, "J129"));
}

Wavefront aberrated() {
    return Wavefront({{0, 0, 0, 0.02, 0.03, -0.01, 0.02, 0.04}}, 1.18);
}

PsfSettings settings(double eps, double radius) {
    return {.wavelength = wavelength, .pixel_scale = pixel_scale, .eps = eps, .radius = radius};
}

double largest_difference(const Plane<double> &a, const Plane<double> &b) {
    double worst = 0;
    for (int64_t y = 0; y < a.ny(); ++y)
        for (int64_t x = 0; x < a.nx(); ++x)
            worst = std::max(worst, std::abs(a(x, y) - b(x, y)));
    return worst;
}

// The same stamp from a small field and from one that holds it, for any settings.
void expect_strips_meet_the_field(const std::shared_ptr<const Aperture> &aperture,
                                  const Light &light, PsfSettings s, int64_t oversampling) {
    const Optics optics{aperture, aberrated(), wavelength};
    s.radius = 24;
    const Psf wide = std::move(make_psfs(optics, {&light, 1}, s)[0]);
    s.radius = 3;
    const Psf narrow = std::move(make_psfs(optics, {&light, 1}, s)[0]);
    const Star star{21.3 * static_cast<double>(oversampling),
                    22.8 * static_cast<double>(oversampling), 2};
    Plane<double> expected(45 * oversampling, 41 * oversampling);
    wide.draw(star, oversampling, expected.view());
    const double tolerance = 2 * s.eps * 2 * wide.peak();
    const StampMemory memory = narrow.draw_memory(star, oversampling, expected.nx(), expected.ny());
    EXPECT_LT(memory.least, memory.most);
    double one_go = 0;
    for (const int64_t limit : {memory.most, (memory.least + memory.most) / 2, memory.least}) {
        Plane<double> stamp(expected.nx(), expected.ny());
        const double error = narrow.draw(star, oversampling, stamp.view(), Psf::Drawing::overwrites,
                                         {.memory_limit = limit});
        EXPECT_LE(error, s.eps);
        EXPECT_LE(largest_difference(stamp, expected), tolerance) << limit;
        one_go = one_go == 0 ? stamp(20, 20) : one_go;
        EXPECT_NEAR(stamp(20, 20), one_go, 1e-14);
    }
    Plane<double> untouched(expected.nx(), expected.ny());
    EXPECT_THROW(narrow.draw(star, oversampling, untouched.view(), Psf::Drawing::adds,
                             {.memory_limit = memory.least - 1}),
                 Error);
    EXPECT_EQ(untouched(20, 20), 0);
}

TEST(LargeStamp, StripsMeetTheFieldHeldInMemory) {
    const std::shared_ptr<const Aperture> c5 = make_aperture(c5_pupil());
    const Light one = monochromatic(wavelength);
    for (const double eps : {1e-4, 1e-7, 1e-10})
        expect_strips_meet_the_field(c5, one, settings(eps, 0), 1);
    expect_strips_meet_the_field(c5, one, settings(1e-7, 0), 3);
    PsfSettings mirrored = settings(1e-7, 0);
    mirrored.mirrored = true;
    expect_strips_meet_the_field(c5, one, mirrored, 1);
    PsfSettings blurred = settings(1e-7, 0);
    blurred.blur = {0.2, 0.1, 0.3};
    expect_strips_meet_the_field(c5, one, blurred, 1);
    const Light colours = detected_light(Instrument::get("wfirst-afta-c5").band("J129"),
                                         power_law_sed(SedUnit::photons, 0));
    expect_strips_meet_the_field(c5, colours, settings(1e-5, 0), 1);
    // A mask: 40 by 40 pixels of 6 cm.
    Plane<double> mask(40, 40);
    for (int64_t y = 0; y < 40; ++y)
        for (int64_t x = 0; x < 40; ++x)
            mask(x, y) = std::hypot(static_cast<double>(x) - 20, static_cast<double>(y) - 19) < 19;
    expect_strips_meet_the_field(make_aperture(std::as_const(mask).view(), 0.06, 20, 19), one,
                                 settings(1e-7, 0), 1);
}

// Along the axes, the diagonal and in between, at 5, 15 and 60 arcsec.
std::vector<std::pair<int64_t, int64_t>> in_the_wings(int64_t centre) {
    std::vector<std::pair<int64_t, int64_t>> pixels;
    for (const double distance : {5.0, 15.0, 60.0})
        for (const double azimuth : {0.0, 0.9, 2.4, 4.0}) {
            const double pix = distance / 0.11;
            pixels.emplace_back(centre + std::llround(pix * std::cos(azimuth)),
                                centre + std::llround(pix * std::sin(azimuth)));
        }
    return pixels;
}

TEST(LargeStamp, WingsMeetTheAiryPattern) {
    const AnnularPupil pupil = Instrument::get("wfirst-afta-c5").annular_pupil();
    const Intensity truth = airy(pupil, wavelength);
    const int64_t centre = 560, n = 2 * centre + 1;
    const Star star{centre + 0.31, centre - 0.22, 1};
    const Psf psf(make_aperture(pupil), Wavefront({}, 1.18), settings(1e-10, 8));
    Plane<double> image(n, n);
    const double error = psf.draw(star, 1, image.view());
    EXPECT_LE(error, 1e-10);
    for (const auto &[x, y] : in_the_wings(centre)) {
        const double expected =
            in_pixel(truth, (static_cast<double>(x) - star.x) * pixel_scale,
                     (static_cast<double>(y) - star.y) * pixel_scale, pixel_scale);
        EXPECT_NEAR(image(x, y), expected, error * psf.peak()) << x << ' ' << y;
        EXPECT_NEAR(image(x, y) / expected, 1, 1e-3) << x << ' ' << y;
    }
    // No light is folded back: what the image lacks of all light lies beyond it.
    double sum = 0;
    for (int64_t y = 0; y < n; ++y)
        for (int64_t x = 0; x < n; ++x)
            sum += image(x, y);
    EXPECT_LT(sum, 1);
    EXPECT_GT(sum, 0.998);
}

TEST(LargeStamp, AberratedWingsMeetABruteForceSum) {
    const int64_t centre = 140, n = 2 * centre + 1;
    const Star star{centre - 0.4, centre + 0.15, 1};
    const Psf psf(make_aperture(c5_pupil()), aberrated(), settings(1e-9, 8));
    Plane<double> image(n, n);
    const double error = psf.draw(star, 1, image.view());
    EXPECT_LE(error, 1e-9);
    const PupilNodes nodes = pupil_nodes(c5_pupil(), 1100, 1e-9);
    for (const auto &[x, y] : {std::pair<int64_t, int64_t>{centre + 136, centre},
                               {centre - 23, centre + 39},
                               {0, 0},
                               {centre, centre}})
        EXPECT_NEAR(image(x, y),
                    brute_force_in_pixel(nodes, aberrated(), wavelength,
                                         (static_cast<double>(x) - star.x) * pixel_scale,
                                         (static_cast<double>(y) - star.y) * pixel_scale,
                                         pixel_scale, 10),
                    error * psf.peak())
            << x << ' ' << y;
}

// A star far from the image, added to it, in float and flipped.
TEST(LargeStamp, LightIsAddedToWhatIsThere) {
    const Psf psf(make_aperture(c5_pupil()), aberrated(), settings(1e-8, 8));
    std::vector<float> pixels(20 * 10, 5);
    const View<float> image{pixels.data() + 199, 20, 10, -1, -20};
    const Star star{-60, 30, 1e8};
    psf.draw(star, 1, image, Psf::Drawing::adds);
    Plane<double> alone(20, 10);
    psf.draw(star, 1, alone.view());
    for (int64_t y = 0; y < 10; ++y)
        for (int64_t x = 0; x < 20; ++x)
            EXPECT_NEAR(image(x, y), 5 + alone(x, y), 1e-6 * (5 + alone(x, y)));
    // And one within the radius.
    psf.draw({10, 5, 100}, 1, image, Psf::Drawing::adds);
    EXPECT_GT(image(10, 5), 20);
}

TEST(LargeStamp, ProgressRisesAndStops) {
    const Psf psf(make_aperture(c5_pupil()), aberrated(), settings(1e-6, 8));
    Plane<double> image(101, 101);
    const Star star{50, 50, 1};
    const int64_t limit = psf.draw_memory(star, 1, 101, 101).least;
    double last = -1;
    int calls = 0;
    const Progress watch{[&](double part) {
        EXPECT_GE(part, last);
        EXPECT_LE(part, 1);
        last = part;
        return ++calls != 4;
    }};
    try {
        psf.draw(star, 1, image.view(), Psf::Drawing::overwrites,
                 {.progress = watch, .memory_limit = limit});
        ADD_FAILURE() << "not stopped";
    } catch (const Error &error) {
        EXPECT_EQ(error.status(), WFPSF_ERROR_CANCELLED);
    }
    EXPECT_EQ(calls, 4);
}

} // namespace
} // namespace wfpsf
