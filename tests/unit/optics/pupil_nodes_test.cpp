// SPDX-License-Identifier: GPL-3.0-or-later
#include "instrument/instrument.hpp"
#include "optics/pupil_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>

namespace wfpsf {
namespace {

constexpr double pi = std::numbers::pi;
using Complex = std::complex<double>;

const SegmentedPupil &c5_pupil() {
    return std::get<SegmentedPupil>(Instrument::get("wfirst-afta-c5").pupil(7, "J129"));
}

Complex transform(const PupilNodes &nodes, double kx, double ky) {
    Complex sum = 0;
    for (size_t i = 0; i < nodes.size(); ++i)
        sum += nodes.weight[i] * std::polar(1.0, kx * nodes.x[i] + ky * nodes.y[i]);
    return sum;
}

double squared_distance(const Circle &c, double x, double y) {
    return (x - c.x) * (x - c.x) + (y - c.y) * (y - c.y);
}

// Lit by the geometry's definition, not by its parametrisation: inside the outer circle, outside
// the obscuration, on the lit side of a segment's edges, and not in a corner between fillet,
// edge and rim.
bool lit(const SegmentedPupil &pupil, double x, double y) {
    const double outer = std::sqrt(squared_distance(pupil.outer, x, y));
    const double inner = std::sqrt(squared_distance(pupil.obscuration, x, y));
    if (outer > pupil.outer.radius || inner < pupil.obscuration.radius)
        return false;
    for (const PupilSegment &segment : pupil.segments) {
        const HalfPlane &a = segment.clockwise_edge, &b = segment.counterclockwise_edge;
        const double from_a = a.nx * x + a.ny * y - a.d, from_b = b.nx * x + b.ny * y - b.d;
        const double mx = a.nx + b.nx, my = a.ny + b.ny; // away from the axis
        if (from_a < 0 || from_b < 0 || x * mx + y * my < 0)
            continue;
        const double rho = pupil.corner_radius;
        for (const HalfPlane &edge : {a, b})
            for (const auto &[circle, side] :
                 {std::pair(pupil.outer, -1.0), std::pair(pupil.obscuration, 1.0)}) {
                // The fillet's centre: rho from the edge and from the rim.
                const double reach = circle.radius + side * rho;
                const double along = edge.nx * circle.x + edge.ny * circle.y;
                const double d = edge.d + rho - along;
                double tx = -edge.ny, ty = edge.nx;
                if (tx * mx + ty * my < 0)
                    tx = -tx, ty = -ty;
                const double h = std::sqrt(reach * reach - d * d);
                const double fx = circle.x + d * edge.nx + h * tx;
                const double fy = circle.y + d * edge.ny + h * ty;
                // The corner's own side of both tangent points.
                const double rim_x = (fx - circle.x) / reach, rim_y = (fy - circle.y) / reach;
                const bool beyond_edge_tangent = side * ((x - fx) * tx + (y - fy) * ty) < 0;
                const double turn = rim_x * (y - circle.y) - rim_y * (x - circle.x);
                const double edge_turn = -(rim_x * edge.ny - rim_y * edge.nx);
                const bool beyond_rim_tangent = turn * edge_turn > 0;
                const double from_fillet = std::hypot(x - fx, y - fy);
                if (beyond_edge_tangent && beyond_rim_tangent && from_fillet > rho &&
                    from_fillet < 3 * rho)
                    return false;
            }
        return true;
    }
    return false;
}

// Midpoint sums over a fine raster of the definition: an oracle that shares nothing with the nodes.
TEST(PupilNodes, SegmentsMeetARasterOfTheDefinition) {
    const SegmentedPupil &pupil = c5_pupil();
    const PupilNodes nodes = pupil_nodes(pupil, 60, 1e-12);
    const int n = 6000;
    const double side = 2.4, h = side / n;
    double area = 0;
    const double waves[][2] = {{3, 1}, {-7, 11}, {20, 15}, {-40, 20}};
    Complex sums[4] = {};
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const double x = (i + 0.5) * h - side / 2, y = (j + 0.5) * h - side / 2;
            if (!lit(pupil, x, y))
                continue;
            area += h * h;
            if (i % 4 == 0 && j % 4 == 0)
                for (int k = 0; k < 4; ++k)
                    sums[k] += std::polar(16 * h * h, waves[k][0] * x + waves[k][1] * y);
        }
    EXPECT_NEAR(transform(nodes, 0, 0).real() / area, 1, 5e-6);
    for (int k = 0; k < 4; ++k)
        EXPECT_LT(std::abs(transform(nodes, waves[k][0], waves[k][1]) - sums[k]), 2e-4 * area);
}

// Exponential convergence, and to one value whatever the number of nodes.
TEST(PupilNodes, ErrorFollowsTheToleranceAskedFor) {
    const double wavenumber = 60;
    const PupilNodes truth = pupil_nodes(c5_pupil(), 2 * wavenumber, 1e-15);
    const double area = transform(truth, 0, 0).real();
    size_t last = 0;
    for (const double eps : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
        const PupilNodes nodes = pupil_nodes(c5_pupil(), wavenumber, eps);
        EXPECT_GT(nodes.size(), last);
        last = nodes.size();
        double worst = 0;
        for (int k = 0; k < 24; ++k) {
            const double kx = wavenumber * std::cos(pi * k / 12);
            const double ky = wavenumber * std::sin(pi * k / 12);
            worst = std::max(worst, std::abs(transform(nodes, kx, ky) - transform(truth, kx, ky)));
        }
        EXPECT_LE(worst, 3 * eps * area) << eps << ' ' << nodes.size();
    }
}

TEST(PupilNodes, AreaOfTheGeometryIsTheMasks) {
    const double pixel = 1.18 / 849.0400461697905;
    const PupilNodes nodes = pupil_nodes(c5_pupil(), 1, 1e-15);
    EXPECT_NEAR(transform(nodes, 0, 0).real() / (1783865 * pixel * pixel), 1, 1e-5);
}

TEST(PupilNodes, AnnulusMeetsItsBesselFunctions) {
    const AnnularPupil pupil{1.18, 0.354};
    for (const double eps : {1e-4, 1e-8, 1e-13}) {
        const PupilNodes nodes = pupil_nodes(pupil, 60, eps);
        for (const double k : {0.5, 7.0, 33.0, 60.0}) {
            const double exact =
                2 * pi *
                (pupil.outer_radius * std::cyl_bessel_j(1, k * pupil.outer_radius) -
                 pupil.inner_radius * std::cyl_bessel_j(1, k * pupil.inner_radius)) /
                k;
            EXPECT_LT(std::abs(transform(nodes, 0.6 * k, 0.8 * k) - exact), 3 * eps + 1e-14);
        }
    }
}

} // namespace
} // namespace wfpsf
