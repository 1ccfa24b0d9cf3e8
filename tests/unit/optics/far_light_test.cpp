// SPDX-License-Identifier: GPL-3.0-or-later
#include "error/error.hpp"
#include "instrument/instrument.hpp"
#include "large_case.hpp"
#include "optics/far_light.hpp"
#include "optics/psf.hpp"
#include "optics/pupil_edges.hpp"
#include "optics/roman_region.hpp"
#include "optics/spider_region.hpp"
#include "oracles/psf_oracle.hpp"
#include "oracles/tilted_star.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <tuple>
#include <vector>

namespace wfpsf {
namespace {

using namespace oracle;

PsfSettings settings(double eps = 1e-4, double reach = 8.5) {
    return {.wavelength = reference_wavelength,
            .pixel_scale = native_pixel,
            .eps = eps,
            .radius = reach};
}

// ------------------------------------------------------------------------------------------- edges

// Half the integral of x dy - y dx around all lit area.
double area_inside(const PupilEdges &edges) {
    double sum = 0;
    for (const auto &[x0, y0, x1, y1] : edges.straight)
        sum += (x0 * y1 - x1 * y0) / 2;
    const GaussLegendre rule(40);
    for (const CurvedEdge &edge : edges.curved) {
        const Oval &o = edge.oval;
        const double half = (edge.end - edge.begin) / 2 * (edge.lit_inside ? 1 : -1);
        for (size_t i = 0; i < rule.x.size(); ++i) {
            const double a = (edge.begin + edge.end + (edge.end - edge.begin) * rule.x[i]) / 2;
            const double u = std::cos(a), v = std::sin(a);
            const double x = o.x + o.half_width * u, y = o.y + o.shear * u + o.half_height * v;
            const double dx = -o.half_width * v, dy = -o.shear * v + o.half_height * u;
            sum += rule.w[i] * half * (x * dy - y * dx) / 2;
        }
    }
    return sum;
}

TEST(PupilEdges, GoAroundTheLitAreaOfEveryPupil) {
    std::vector<std::pair<const char *, std::shared_ptr<const Aperture>>> apertures;
    for (const char *band : {"J129", "F184"})
        apertures.emplace_back(band, TiltedStar("roman-c9", band).aperture);
    apertures.emplace_back("c5", TiltedStar("wfirst-afta-c5", "J129").aperture);
    apertures.emplace_back("annulus", make_aperture(AnnularPupil{1.2, 0.4}));
    apertures.emplace_back(
        "spider", make_aperture(SpiderPupil{1.2, 0.36, {{0, 1, 0, 0.05}, {1, 0, 0.1, 0.03}}}));
    for (const auto &[name, aperture] : apertures)
        EXPECT_NEAR(area_inside(pupil_edges(aperture->parts())), aperture->area(), 1e-9) << name;
}

TEST(PupilEdges, RoundedCornersGoOnFromStraightEdges) {
    const PupilEdges edges = pupil_edges(TiltedStar("wfirst-afta-c5", "J129").aperture->parts());
    EXPECT_EQ(edges.straight.size(), 12U);
    int round = 0; // corners of struts
    for (const Junction &junction : junctions(edges)) {
        EXPECT_NEAR(junction.end.x, junction.other.x, 1e-5);
        EXPECT_NEAR(junction.end.y, junction.other.y, 1e-5);
        if (junction.end.is_curved == junction.other.is_curved)
            continue;
        EXPECT_LT(junction.kink, 1e-6);
        ++round;
    }
    EXPECT_EQ(round, 2 * 24);
}

// ------------------------------------------------------------------------------------------- light

struct Patch {
    int64_t x, y;       // middle, native pixels from the star
    double sum, bright; // largest error of the sum, and rms error of the bright pixels
};

constexpr int64_t half = 8; // of a patch

void expect_like(const Plane<double> &truth, const FarLight &far, const Patch &patch) {
    const auto &[x, y, most_sum, most_bright] = patch;
    double peak = 0, sum = 0, off = 0;
    for (int64_t j = 0; j <= 2 * half; ++j)
        for (int64_t i = 0; i <= 2 * half; ++i) {
            peak = std::max(peak, truth(i, j));
            sum += truth(i, j);
            off += far.at(static_cast<double>(x + i - half), static_cast<double>(y + j - half)) -
                   truth(i, j);
        }
    double squares = 0, count = 0;
    for (int64_t j = 0; j <= 2 * half; ++j)
        for (int64_t i = 0; i <= 2 * half; ++i)
            if (truth(i, j) > 0.3 * peak) {
                const double light =
                    far.at(static_cast<double>(x + i - half), static_cast<double>(y + j - half));
                squares += std::pow(light / truth(i, j) - 1, 2);
                ++count;
            }
    EXPECT_LT(std::abs(off / sum), most_sum) << x;
    EXPECT_LT(std::sqrt(squares / count), most_bright) << x;
}

void expect_like_the_engine(const TiltedStar &scene, const std::vector<Patch> &patches) {
    const FarLight far(scene.optics(), scene.light, settings());
    for (const Patch &patch : patches) {
        const auto there = scene.optics(static_cast<double>(patch.x), static_cast<double>(patch.y));
        const Psf psf = std::move(make_psfs(there, {&scene.light, 1}, settings())[0]);
        Plane<double> truth(2 * half + 1, 2 * half + 1);
        psf.draw({half, half, 1}, 1, truth.view());
        expect_like(truth, far, patch);
    }
}

// All pixels of a ring, on the spikes and between them.
void expect_errors_as_estimated(const Optics &optics, const Light &light) {
    constexpr int64_t radius = 72, nearest = 40;
    const FarLight far(optics, light, settings());
    const Psf psf = std::move(make_psfs(optics, {&light, 1}, settings(1e-8, radius + 2))[0]);
    constexpr int64_t size = 2 * radius + 1;
    Plane<double> truth(size, size), mine(size, size);
    psf.draw({radius, radius, 1}, 1, truth.view());
    far.add({radius, radius, 1}, nearest / 1.5, 1e-13, mine.view());
    const auto spikes = far.spikes(nearest, 1e-13);
    constexpr double near = 12; // of a spike
    double worst = 0;
    for (int64_t j = 0; j < size; ++j)
        for (int64_t i = 0; i < size; ++i) {
            const auto x = static_cast<double>(i - radius), y = static_cast<double>(j - radius);
            const double r = std::hypot(x, y);
            if (r < nearest)
                continue;
            const bool on = std::ranges::any_of(spikes, [&](const FarLight::Direction &spike) {
                return std::abs(spike.x * y - spike.y * x) < near;
            });
            const FarLight::Error share = far.relative_error(r);
            const double most =
                on ? share.spikes * far.brightest_beyond(r) : share.halo * far.halo_beyond(r);
            worst = std::max(worst, std::abs(mine(i, j) - truth(i, j)) / most);
        }
    EXPECT_LT(worst, 1);
    EXPECT_GT(worst, 0.2);
}

TEST(FarLight, HasTheErrorsThatItEstimates) {
    for (const auto &[name, band, sca] :
         {std::tuple("roman-c9", "J129", 1), std::tuple("roman-c9", "K213", 18),
          std::tuple("roman-c9", "H158", 12), std::tuple("wfirst-afta-c5", "F184", 7)}) {
        SCOPED_TRACE(band);
        const Instrument &instrument = Instrument::get(name);
        const auto aperture = std::visit(
            [](const auto &pupil) { return std::shared_ptr<const Aperture>(make_aperture(pupil)); },
            instrument.pupil(sca, band));
        const TiltedStar source(name, band, aperture);
        const auto waves = instrument.zernikes(sca);
        expect_errors_as_estimated(tilted(aperture, {waves.begin(), waves.end()}, 0, 0),
                                   source.light);
    }
}

TEST(FarLight, IsThatOfTheExactEngineForRoman) {
    expect_like_the_engine({"roman-c9", "J129"}, {{62, 15, 0.004, 0.02}, {124, 31, 0.002, 0.004}});
}

// There the strut's short end beside it is seen 20 pixels off its own spike: it took 5 % of the light.
TEST(FarLight, IsThatOfTheExactEngineBeyondTheTablesOfSpikes) {
    WFPSF_LARGE_CASE();
    const TiltedStar scene("roman-c9", "J129");
    const Patch patch{356, 87, 0.003, 0.006};
    const auto x = static_cast<double>(patch.x), y = static_cast<double>(patch.y);
    const Psf psf =
        std::move(make_psfs(scene.optics(), {&scene.light, 1}, settings(1e-9, x + half + 1))[0]);
    Plane<double> truth(2 * half + 1, 2 * half + 1);
    const Star star{half - x, half - y, 1};
    psf.add(std::span(&star, 1), 1, truth.view(), 1);
    expect_like(truth, FarLight(scene.optics(), scene.light, settings()), patch);
}

TEST(FarLight, IsThatOfTheExactEngineForTaperedStrutsAndRoundedCorners) {
    expect_like_the_engine({"wfirst-afta-c5", "F184"}, {{126, 20, 0.008, 0.02}});
}

// Edges on one line interfere however far off.
TEST(FarLight, IsThatOfTheExactEngineForStrutsThatFaceEachOther) {
    const double c = std::cos(0.3), s = std::sin(0.3);
    const SpiderPupil cross{
        1.2, 0.36, {{c, s, 0, 0.05}, {-s, c, 0, 0.05}, {-c, -s, 0, 0.05}, {s, -c, 0, 0.05}}};
    expect_like_the_engine({"roman-c9", "J129", make_aperture(cross)},
                           {{61, 19, 0.003, 0.006}, {-29, 93, 0.003, 0.006}});
}

// An annulus has no straight edge: per unit of solid angle, the mean of the obscured Airy pattern.
TEST(FarLight, OfAnAnnulusIsTheMeanOfItsRings) {
    const AnnularPupil pupil{1.2, 0.4};
    const Light light =
        detected_light(Instrument::get("roman-c9").band("J129"), black_body_sed(5000));
    const std::shared_ptr<const Aperture> aperture = make_aperture(pupil);
    const FarLight far({aperture, Wavefront({}, pupil_radius), reference_wavelength}, light,
                       settings());
    EXPECT_TRUE(far.spikes(100, 1e-20).empty());
    const Spectrum spectrum = light(1e-4);
    double truth = 0, mine = 0;
    for (int step = 0; step < 60; ++step) { // of a tenth of a pixel
        const double r = 100 + 0.1 * step;
        mine += far.at(0.6 * r, 0.8 * r);
        for (size_t q = 0; q < spectrum.size(); ++q)
            truth += spectrum.weight[q] *
                     airy(pupil, spectrum.wavelength[q])(0.6 * r * native_pixel,
                                                         0.8 * r * native_pixel) *
                     native_pixel * native_pixel;
    }
    EXPECT_NEAR(mine / truth, 1, 0.01);
}

TEST(FarLight, IsMirroredWithThePupil) {
    const TiltedStar scene("roman-c9", "J129");
    PsfSettings other = settings();
    other.mirrored = true;
    const FarLight plain(scene.optics(), scene.light, settings());
    const FarLight mirrored(scene.optics(), scene.light, other);
    for (const auto &[x, y] : {std::pair(62, 15), std::pair(-40, 70), std::pair(3, -99)})
        EXPECT_NEAR(mirrored.at(x, -y) / plain.at(x, y), 1, 1e-12);
    const auto a = plain.spikes(100, 1e-12), b = mirrored.spikes(100, 1e-12);
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(a[1].x, b[1].x);
    EXPECT_EQ(a[1].y, -b[1].y);
}

TEST(FarLight, IsAddedOutsideTheStampDownToTheFloor) {
    const TiltedStar scene("roman-c9", "J129");
    const FarLight far(scene.optics(), scene.light, settings());
    const Star star{70.3, 210.6, 1e8};
    constexpr double inner = 40, floor = 0.1;
    const auto parts = static_cast<double>(2 * far.spikes(100, 1e-20).size() + 1);
    Plane<double> image(300, 260), again(300, 260);
    for (int64_t x = 0; x < image.nx(); ++x)
        image(x, 7) = again(x, 7) = 3;
    far.add(star, inner, floor, image.view());
    far.add(star, inner, floor, again.view(), 3);
    double left_out = 0;
    for (int64_t y = 0; y < image.ny(); ++y)
        for (int64_t x = 0; x < image.nx(); ++x) {
            ASSERT_EQ(image(x, y), again(x, y));
            const double dx = static_cast<double>(x) - star.x, dy = static_cast<double>(y) - star.y;
            const double before = y == 7 ? 3 : 0;
            if (std::max(std::abs(dx), std::abs(dy)) <= inner) {
                ASSERT_EQ(image(x, y), before);
                continue;
            }
            const double light = star.flux * far.at(dx, dy), off = light - image(x, y) + before;
            ASSERT_LT(std::abs(off), parts * floor) << x << ' ' << y;
            left_out = std::max(left_out, off);
            ASSERT_LE(light, star.flux * far.brightest_beyond(std::hypot(dx, dy)));
        }
    EXPECT_GT(left_out, floor / 10);
}

TEST(FarLight, RefusesWhatItHasNoTheoryFor) {
    const TiltedStar scene("roman-c9", "J129");
    EXPECT_THROW(FarLight(scene.optics(), monochromatic(1e-6), settings()), Error);
    Plane<double> mask(8, 8);
    mask(4, 4) = 1;
    Optics pixels = scene.optics();
    pixels.aperture = make_aperture(mask.view(), 0.3, 3.5, 3.5);
    EXPECT_THROW(FarLight(pixels, scene.light, settings()), Error);
    const FarLight far(scene.optics(), scene.light, settings());
    EXPECT_THROW(far.add({0, 0, 1}, far.nearest() - 1, 1e-9, mask.view()), Error);
    EXPECT_THROW(far.add({0, 0, 1}, 40, 0, mask.view()), Error);
}

} // namespace
} // namespace wfpsf
