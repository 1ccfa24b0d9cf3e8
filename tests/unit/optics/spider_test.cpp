// SPDX-License-Identifier: GPL-3.0-or-later
// Obscured discs behind struts of any kind: nodes and PSFs against closed forms and a scan of the
// definition that shares no code with them.
#include "error/error.hpp"
#include "instrument/instrument.hpp"
#include "optics/psf.hpp"
#include "optics/spider_region.hpp"
#include "oracles/psf_oracle.hpp"
#include "oracles/spider_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace wfpsf {
namespace {

using namespace oracle;
using Complex = std::complex<double>;

constexpr double pixel_scale = 0.11 * pi / 180 / 3600, wavelength = 1292e-9;

Strut bar(double azimuth_deg, double width, double offset = 0) {
    const double a = azimuth_deg * pi / 180;
    return {std::sin(a), -std::cos(a), -offset, width};
}

SpiderPupil spider(double inner, int count, double first_deg, double width, double offset = 0) {
    SpiderPupil pupil{1, inner, {}};
    for (int i = 0; i < count; ++i)
        pupil.struts.push_back(bar(first_deg + 360.0 * i / count, width, offset));
    return pupil;
}

struct Case {
    std::string name;
    SpiderPupil pupil;
};

std::vector<Case> cases() {
    std::vector<Case> all{
        {"no obscuration, one strut", spider(0, 1, 17, 0.05)},
        {"no obscuration, cross", spider(0, 4, 0, 0.02)},
        {"no obscuration, seven that overlap near the axis", spider(0, 7, 5, 0.1)},
        {"thin ring", spider(0.95, 3, 90, 0.1)},
        {"hair", spider(0.3, 4, 45, 1e-4)},
        {"almost nothing", spider(0.3, 3, 11, 1e-9)},
        {"widest", spider(0.2, 5, -77, 0.2)},
        {"wider than the obscuration", spider(0.05, 3, 30, 0.2)},
        {"off the axis", spider(0.3, 6, 12, 0.03, 0.25)},
        {"far off the axis", spider(0.3, 3, 50, 0.1, 0.9)},
        {"partly outside, wholly outside", {1, 0.3, {bar(30, 0.2, 0.95), bar(77, 0.1, -3)}}},
        {"twice the same", {1, 0.3, {bar(30, 0.05), bar(30, 0.05), bar(-60, 0.04)}}},
        {"almost upright", {1, 0.2, {bar(90 + 1e-7, 0.05), bar(270 - 1e-5, 0.05, 1e-9)}}},
        {"edges along the obscuration",
         {1, 0.1, {bar(0, 0.2), bar(120, 0.2), bar(200, 0.1, 0.05)}}},
        {"many", spider(0.4, 11, 1, 0.02)},
    };
    return all;
}

Complex transform(const PupilNodes &nodes, double kx, double ky) {
    Complex sum = 0;
    for (size_t i = 0; i < nodes.size(); ++i)
        sum += nodes.weight[i] * std::polar(1.0, kx * nodes.x[i] + ky * nodes.y[i]);
    return sum;
}

TEST(Spider, NodesMeetAScanOfTheDefinition) {
    constexpr double waves[][2] = {{0, 0}, {3, 1}, {-7, 11}, {20, 15}, {-40, 20}, {10, 58}};
    for (const auto &[name, pupil] : cases()) {
        const SpiderScan scan(pupil);
        const std::vector<Cell> cells = lit_cells(lit_region(pupil));
        for (const double eps : {1e-3, 1e-6, 1e-10}) {
            const PupilNodes nodes = pupil_nodes(cells, 60, eps);
            for (const auto &[kx, ky] : waves)
                EXPECT_LE(std::abs(transform(nodes, kx, ky) - scan.transform(kx, ky)),
                          2 * eps * scan.area())
                    << name << ' ' << eps << ' ' << kx << ' ' << ky;
        }
    }
}

// Struts that do not overlap outside of the obscuration.
TEST(Spider, AreaMeetsItsClosedForm) {
    // Of the unit disc's part right of the axis, between parallels at -w/2 and w/2.
    const auto strip = [](double radius, double w) {
        const double h = w / 2;
        return radius * radius * std::asin(h / radius) + h * std::sqrt(radius * radius - h * h);
    };
    for (const double inner : {0.2, 0.3, 0.95})
        for (const int count : {1, 3, 6})
            for (const double width : {1e-6, 0.01, 0.2}) {
                const double exact =
                    pi * (1 - inner * inner) - count * (strip(1, width) - strip(inner, width));
                EXPECT_NEAR(make_aperture(spider(inner, count, 13, width))->area(), exact,
                            1e-13 * pi)
                    << inner << ' ' << count << ' ' << width;
            }
    EXPECT_NEAR(make_aperture(spider(0.4, 64, 1, 0.02))->area(),
                pi * (1 - 0.4 * 0.4) - 64 * (strip(1, 0.02) - strip(0.4, 0.02)), 1e-12);
}

constexpr double star_x = 12.3, star_y = 11.8;
constexpr std::pair<int, int> probes[] = {{12, 12}, {13, 12}, {12, 10}, {7, 15}, {0, 0}, {24, 1}};

// in_pixel: the truth, by angles.
template <class InPixel>
void expect_psf(const std::string &name, const SpiderPupil &pupil, const InPixel &in_pixel) {
    std::vector<double> truth;
    for (const auto &[x, y] : probes)
        truth.push_back(in_pixel((x - star_x) * pixel_scale, (y - star_y) * pixel_scale));
    for (const double eps : {1e-3, 1e-6, 1e-10}) {
        const Psf psf(make_aperture(pupil), Wavefront({}, 1), {wavelength, pixel_scale, eps, 13});
        Plane<double> stamp(25, 25);
        psf.draw({star_x, star_y, 1}, 1, stamp.view());
        double peak = 0, worst = 0;
        for (int64_t y = 0; y < 25; ++y)
            for (int64_t x = 0; x < 25; ++x)
                peak = std::max(peak, stamp(x, y));
        for (size_t i = 0; i < truth.size(); ++i)
            worst = std::max(worst,
                             std::abs(stamp(probes[i].first, probes[i].second) - truth[i]) / peak);
        EXPECT_LE(worst, eps) << name;
        EXPECT_LE(worst, psf.error_estimate()) << name << ' ' << eps;
        EXPECT_LE(psf.error_estimate(), eps) << name;
    }
}

TEST(Spider, PsfsMeetTheScanAtEveryTolerance) {
    for (const auto &[name, pupil] : cases()) {
        const SpiderScan scan(pupil);
        expect_psf(name, pupil, [&](double x, double y) {
            return scan.in_pixel(x, y, pixel_scale, wavelength);
        });
    }
}

TEST(Spider, WithoutStrutsIsAnAiryPattern) {
    for (const double inner : {0.0, 1e-9, 0.3, 0.95, 0.99})
        expect_psf("inner radius " + std::to_string(inner), {1, inner, {}},
                   [&](double x, double y) {
                       return in_pixel(airy({1, inner}, wavelength), x, y, pixel_scale);
                   });
}

TEST(Spider, WithoutLightIsRefused) {
    EXPECT_THROW(make_aperture(SpiderPupil{1, 0.3, {bar(0, 2), bar(180, 2)}}), Error);
    EXPECT_THROW(make_aperture(SpiderPupil{1, 0.99, {bar(0, 2), bar(180, 2 - 1e-9)}}), Error);
}

} // namespace
} // namespace wfpsf
