// SPDX-License-Identifier: GPL-3.0-or-later
#include "instrument/instrument.hpp"
#include "optics/roman_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>
#include <utility>
#include <vector>

namespace wfpsf {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double pixel = 1.17978731902147e-3; // of the published masks, m
using Complex = std::complex<double>;

const RomanPupil &pupil(int sca, const char *band) {
    return std::get<RomanPupil>(Instrument::get("roman-c9").pupil(sca, band));
}

PupilNodes pupil_nodes(const RomanPupil &pupil, double wavenumber, double eps) {
    return pupil_nodes(lit_cells(lit_region(pupil)), wavenumber, eps);
}

Complex transform(const PupilNodes &nodes, double kx, double ky) {
    Complex sum = 0;
    for (size_t i = 0; i < nodes.size(); ++i)
        sum += nodes.weight[i] * std::polar(1.0, kx * nodes.x[i] + ky * nodes.y[i]);
    return sum;
}

// The definition, point by point and in normalised coordinates.

bool inside(const Ellipse &e, double x, double y) {
    const double dx = x - e.x, dy = y - e.y;
    return (1 - e.p) * dx * dx - 2 * e.q * dx * dy + (1 + e.p) * dy * dy <= e.radius * e.radius;
}
bool inside(const Circle &c, double x, double y) {
    return inside(Ellipse{c.x, c.y, c.radius, 0, 0}, x, y);
}
bool covered(const Strut &s, double x, double y) {
    return std::abs(s.nx * x + s.ny * y - s.offset) <= s.width / 2 && s.nx * y - s.ny * x >= 0;
}

// Azimuth about the lower disc's centre of the point where a strut's middle has radius 0.32.
double cut_azimuth(const Strut &s, const Circle &disc) {
    const double along = std::sqrt(0.32 * 0.32 - s.offset * s.offset);
    return std::atan2(s.ny * s.offset + s.nx * along - disc.y,
                      s.nx * s.offset - s.ny * along - disc.x);
}

bool lit(const RomanPupil &pupil, double x, double y) {
    if (pupil.clip && (std::min(x, y) < pupil.clip->low || std::max(x, y) > pupil.clip->high))
        return false;
    // X = Q^(1/2) (x - c) / radius, the root by its eigenvectors.
    const auto &[cx, cy, radius, p, q] = pupil.primary;
    const double bend = std::hypot(p, q), axis = std::atan2(q, p) / 2;
    const double along = std::cos(axis) * (x - cx) + std::sin(axis) * (y - cy);
    const double across = std::cos(axis) * (y - cy) - std::sin(axis) * (x - cx);
    const double u = along * std::sqrt(1 - bend) / radius,
                 v = across * std::sqrt(1 + bend) / radius;
    const double nx = std::cos(axis) * u - std::sin(axis) * v;
    const double ny = std::sin(axis) * u + std::cos(axis) * v;
    if (nx * nx + ny * ny > 1 || !inside(pupil.vignetting, nx, ny))
        return false;
    for (size_t k = 0; k < 6; ++k)
        if (covered(pupil.telescope_struts[k], nx, ny) || covered(pupil.mask_struts[k], nx, ny))
            return false;
    if (const auto *mask = std::get_if<LongWaveMask>(&pupil.mask))
        return inside(mask->outer, nx, ny) && !inside(mask->inner, nx, ny);
    const auto &mask = std::get<ShortWaveMask>(pupil.mask);
    if (inside(mask.upper, nx, ny) || inside(mask.lower, nx, ny))
        return false;
    if (inside(Circle{mask.lower.x, mask.lower.y, mask.enlarged_radius}, nx, ny))
        for (const auto &[from, to] : {std::pair(1, 2), std::pair(3, 4), std::pair(5, 0)}) {
            const auto strut = [&](int k) {
                return cut_azimuth(pupil.telescope_struts[static_cast<size_t>(k)], mask.lower);
            };
            const auto turn = [](double a) { return a < 0 ? a + 2 * pi : a; };
            const double here = std::atan2(ny - mask.lower.y, nx - mask.lower.x);
            if (turn(here - strut(from)) <= turn(strut(to) - strut(from)))
                return false;
        }
    return true;
}

// Sums over lines of constant y, a quarter of a mask's pixel apart; the ends of their lit runs are
// found by bisection between samples two pixels apart. Shares nothing with the nodes.
class Scan {
  public:
    explicit Scan(const RomanPupil &pupil) {
        for (int row = 0; row * step < 2 * reach; ++row) {
            const double y = (row + 0.5) * step - reach;
            const auto end = [&](double low, double high) {
                const bool from = lit(pupil, low, y);
                for (int i = 0; i < 30; ++i)
                    (lit(pupil, (low + high) / 2, y) == from ? low : high) = (low + high) / 2;
                return (low + high) / 2;
            };
            bool before = false;
            double begin = 0;
            for (int sample = 0; sample * 2 * pixel < 2 * reach; ++sample) {
                const double x = sample * 2 * pixel - reach;
                const bool now = lit(pupil, x, y);
                if (now != before) {
                    const double edge = end(x - 2 * pixel, x);
                    if (before)
                        runs_.push_back({y, begin, edge});
                    begin = edge;
                }
                before = now;
            }
        }
    }
    Complex transform(double kx, double ky) const {
        Complex sum = 0;
        for (const auto &[y, begin, end] : runs_) {
            const double half = kx * (end - begin) / 2;
            sum += std::polar((end - begin) * step * (half == 0 ? 1 : std::sin(half) / half),
                              kx * (begin + end) / 2 + ky * y);
        }
        const double half = ky * step / 2;
        return sum * (half == 0 ? 1 : std::sin(half) / half);
    }

  private:
    static constexpr double step = pixel / 4, reach = 1.22;
    struct Run {
        double y, begin, end;
    };
    std::vector<Run> runs_;
};

// Corner detectors, whose struts separate, and one whose mask is clipped most; both masks.
constexpr std::pair<int, const char *> cases[] = {{1, "J129"},  {7, "H158"}, {16, "W146"},
                                                  {18, "R062"}, {4, "F184"}, {16, "K213"}};

TEST(RomanNodes, MeetAScanOfTheDefinition) {
    constexpr double waves[][2] = {{0, 0}, {3, 1}, {-7, 11}, {20, 15}, {-40, 20}, {10, 58}};
    for (const auto &[sca, band] : {cases[1], cases[2], cases[5]}) {
        const PupilNodes nodes = pupil_nodes(pupil(sca, band), 60, 1e-12);
        const Scan scan(pupil(sca, band));
        const double area = scan.transform(0, 0).real();
        for (const auto &[kx, ky] : waves)
            EXPECT_LT(std::abs(transform(nodes, kx, ky) - scan.transform(kx, ky)), 2e-5 * area)
                << sca << ' ' << band << ' ' << kx << ' ' << ky;
    }
}

// The lit area of the published masks, in pixels; the fit is good to 6e-5 of it.
TEST(RomanNodes, HaveTheMasksAreaAndCentroid) {
    struct Mask {
        int sca;
        const char *band;
        double lit, x, y; // pixels, of the array, from 0
    };
    constexpr Mask masks[] = {
        {1, "J129", 2493422, 1026.6528, 1023.1849},  {7, "H158", 2551972, 1024.9622, 1017.8096},
        {9, "Y106", 2493463, 1013.0697, 1012.6758},  {16, "W146", 2533479, 1057.9788, 1041.9096},
        {18, "R062", 2488560, 1040.8373, 1038.2515}, {4, "F184", 2324289, 1012.3380, 1015.3505},
        {10, "F184", 2312335, 1039.1307, 1035.0883}, {16, "K213", 2311666, 1061.9676, 1038.3735},
        {18, "K213", 2257932, 1037.4713, 1026.1493},
    };
    for (const Mask &mask : masks) {
        const PupilNodes nodes = pupil_nodes(pupil(mask.sca, mask.band), 1, 1e-10);
        double area = 0, x = 0, y = 0;
        for (size_t i = 0; i < nodes.size(); ++i) {
            area += nodes.weight[i];
            x += nodes.weight[i] * nodes.x[i];
            y += nodes.weight[i] * nodes.y[i];
        }
        EXPECT_NEAR(area / (pixel * pixel * mask.lit), 1, 6e-5) << mask.sca << ' ' << mask.band;
        EXPECT_NEAR(x / area / pixel + 1024, mask.x, 0.05) << mask.sca << ' ' << mask.band;
        EXPECT_NEAR(y / area / pixel + 1024, mask.y, 0.05) << mask.sca << ' ' << mask.band;
    }
}

// Exponential convergence, and to one value whatever the number of nodes.
TEST(RomanNodes, ErrorFollowsTheToleranceAskedFor) {
    for (const auto &[sca, band] : cases) {
        const std::vector<Cell> cells = lit_cells(lit_region(pupil(sca, band)));
        for (const double wavenumber : {2.0, 60.0}) {
            const PupilNodes truth = pupil_nodes(cells, 2 * wavenumber, 1e-16);
            const double area = transform(truth, 0, 0).real();
            size_t last = 0;
            for (const double eps : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
                const PupilNodes nodes = pupil_nodes(cells, wavenumber, eps);
                EXPECT_GT(nodes.size(), last);
                last = nodes.size();
                for (int i = 0; i < 8; ++i) {
                    const double kx = wavenumber * std::cos(pi * i / 8);
                    const double ky = wavenumber * std::sin(pi * i / 8);
                    EXPECT_LE(std::abs(transform(nodes, kx, ky) - transform(truth, kx, ky)),
                              2 * eps * area)
                        << sca << ' ' << band << ' ' << wavenumber << ' ' << eps;
                }
            }
        }
    }
}

TEST(RomanNodes, AreAsFewAsSmoothCellsAllow) {
    EXPECT_LT(pupil_nodes(pupil(16, "K213"), 60, 1e-6).size(), 6500u);
    EXPECT_LT(pupil_nodes(pupil(1, "J129"), 60, 1e-6).size(), 6000u);
}

TEST(RomanNodes, ReachBeyondTheClipSquareWithoutIt) {
    RomanPupil whole = pupil(16, "J129");
    whole.clip.reset();
    const auto farthest = [](const RomanPupil &p) {
        const PupilNodes nodes = pupil_nodes(p, 60, 1e-12);
        return *std::ranges::max_element(nodes.x);
    };
    EXPECT_LT(farthest(pupil(16, "J129")), 1015.5 * pixel);
    EXPECT_GT(farthest(whole), 1030 * pixel);
    EXPECT_LT(farthest(whole), extent(whole) / 2 + whole.primary.x);
    EXPECT_NEAR(extent(whole), 2.4, 0.01);
}

// Regions whose areas and transforms are known.

constexpr Oval unit_disc{0, 0, 1, 0, 1};
double area(const LitRegion &region) {
    return transform(pupil_nodes(lit_cells(region), 1, 1e-14), 0, 0).real();
}

TEST(LitRegion, OfDiscsMeetsBesselFunctions) {
    const LitRegion ring{{unit_disc}, {{Oval{0.3, -0.1, 0.4, 0, 0.4}}}};
    const PupilNodes nodes = pupil_nodes(lit_cells(ring), 60, 1e-12);
    for (const double k : {0.5, 7.0, 33.0, 60.0}) {
        const double kx = 0.6 * k, ky = 0.8 * k;
        const Complex exact = 2 * pi / k *
                              (std::cyl_bessel_j(1, k) - 0.4 * std::cyl_bessel_j(1, 0.4 * k) *
                                                             std::polar(1.0, kx * 0.3 - ky * 0.1));
        EXPECT_LT(std::abs(transform(nodes, kx, ky) - exact), 1e-11) << k;
    }
}

TEST(LitRegion, OfAnEllipseHasItsAreaAndExtremes) {
    const Oval tilted{0.2, -0.3, 1.5, 0.7, 0.4};
    const std::vector<Cell> cells = lit_cells({{tilted}, {}});
    ASSERT_EQ(cells.size(), 1u);
    EXPECT_DOUBLE_EQ(cells[0].x0, -1.3);
    EXPECT_DOUBLE_EQ(cells[0].x1, 1.7);
    EXPECT_NEAR(area({{tilted}, {}}), pi * 1.5 * 0.4, 1e-13);
}

TEST(LitRegion, OfDiscsThatOverlapTouchOrCoincideHasItsArea) {
    // A lens of two unit discs, their centres a distance d apart.
    for (const double d : {1.9999, 1.0, 1e-3, 1e-6}) {
        const double lens = 2 * std::acos(d / 2) - d / 2 * std::sqrt(4 - d * d);
        const Oval other{0.6 * d, 0.8 * d, 1, 0, 1};
        EXPECT_NEAR(area({{unit_disc, other}, {}}), lens, 1e-12) << d;
        EXPECT_NEAR(area({{unit_disc}, {{other}}}), pi - lens, 1e-12) << d;
    }
    EXPECT_NEAR(area({{unit_disc, unit_disc}, {}}), pi, 1e-13);
    EXPECT_EQ(lit_cells({{unit_disc}, {{unit_disc}}}).size(), 0u);
    // Dark discs that touch the edge, and each other.
    EXPECT_NEAR(
        area({{unit_disc}, {{Oval{0.3, 0.4, 0.5, 0, 0.5}}, {Oval{-0.3, -0.4, 0.5, 0, 0.5}}}}),
        pi / 2, 1e-9);
}

TEST(LitRegion, OfLinesHasItsArea) {
    // A quarter of the disc, less a bar across it; and an upright edge.
    const std::vector<Bound> bar{HalfPlane{0.6, 0.8, 0.4}, HalfPlane{-0.6, -0.8, -0.5}};
    const LitRegion quarter{{unit_disc, HalfPlane{1, 0, 0}, HalfPlane{0, 1, 0}}, {bar}};
    // What the bar covers: from axis to axis, between the parallels at 0.4 and 0.5.
    const double covered = (0.5 * 0.5 - 0.4 * 0.4) / (2 * 0.6 * 0.8);
    EXPECT_NEAR(area(quarter), pi / 4 - covered, 1e-13);
    EXPECT_TRUE(lit_cells({{unit_disc, HalfPlane{0, 1, 2}}, {}}).empty());
}

} // namespace
} // namespace wfpsf
