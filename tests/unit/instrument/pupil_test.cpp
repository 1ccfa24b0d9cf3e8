// SPDX-License-Identifier: GPL-3.0-or-later
#include "instrument/instrument.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

namespace wfpsf {
namespace {

constexpr double metres_per_pixel = 1.389804880609865e-3; // of the mask, as published

const Instrument &c5() {
    return Instrument::get("wfirst-afta-c5");
}
const SegmentedPupil &pupil() {
    return std::get<SegmentedPupil>(c5().pupil(7, "H158"));
}

double depth(const HalfPlane &edge, double x, double y) {
    return edge.nx * x + edge.ny * y - edge.d;
}

// On the side of a circle's centre where a segment with these two edges lies.
bool outwards(const HalfPlane &a, const HalfPlane &b, const Circle &circle, double x, double y) {
    return (a.nx + b.nx) * (x - circle.x) + (a.ny + b.ny) * (y - circle.y) > 0;
}

double distance(const Circle &circle, double x, double y) {
    const double dx = x - circle.x, dy = y - circle.y;
    return std::sqrt(dx * dx + dy * dy);
}

// Where the line that runs at an offset inside an edge meets a circle, on the segment's side.
bool crossing(const HalfPlane &edge, const HalfPlane &other, double offset, const Circle &circle,
              double radius, double &x, double &y) {
    const double across = edge.d + offset - edge.nx * circle.x - edge.ny * circle.y;
    const double square = radius * radius - across * across;
    if (square <= 0)
        return false;
    for (const double along : {std::sqrt(square), -std::sqrt(square)}) {
        x = circle.x + edge.nx * across - edge.ny * along;
        y = circle.y + edge.ny * across + edge.nx * along;
        if (outwards(edge, other, circle, x, y))
            return depth(other, x, y) > 0;
    }
    return false;
}

// A rounded corner: its circle, with the directions to the edge and to the arc that it touches.
struct Fillet {
    double x, y;
    double to_edge_x, to_edge_y, to_arc_x, to_arc_y;
};

std::vector<Fillet> fillets(const SegmentedPupil &p) {
    std::vector<Fillet> all;
    for (const auto &[a, b] : p.segments)
        for (const auto &[edge, other] : {std::pair{a, b}, std::pair{b, a}})
            for (const bool outer : {true, false}) {
                const Circle &arc = outer ? p.outer : p.obscuration;
                const double side = outer ? 1 : -1;
                double x = 0, y = 0;
                if (!crossing(edge, other, p.corner_radius, arc,
                              arc.radius - side * p.corner_radius, x, y))
                    continue;
                const double r = side * distance(arc, x, y);
                all.push_back({x, y, -edge.nx, -edge.ny, (x - arc.x) / r, (y - arc.y) / r});
            }
    return all;
}

// In the sliver that a rounded corner takes away: beyond its circle, between its two contacts.
bool in_sliver(const Fillet &f, double corner_radius, double x, double y) {
    const double dx = x - f.x, dy = y - f.y, r = std::sqrt(dx * dx + dy * dy);
    if (r <= corner_radius || r >= 3 * corner_radius)
        return false;
    const double turn = f.to_edge_x * f.to_arc_y - f.to_edge_y * f.to_arc_x;
    return (f.to_edge_x * dy - f.to_edge_y * dx) * turn > 0 &&
           (dx * f.to_arc_y - dy * f.to_arc_x) * turn > 0;
}

bool lit(const SegmentedPupil &p, const std::vector<Fillet> &corners, double x, double y) {
    if (distance(p.outer, x, y) > p.outer.radius ||
        distance(p.obscuration, x, y) < p.obscuration.radius)
        return false;
    bool in_segment = false;
    for (const auto &[a, b] : p.segments)
        in_segment = in_segment || (depth(a, x, y) >= 0 && depth(b, x, y) >= 0 &&
                                    outwards(a, b, p.obscuration, x, y));
    if (!in_segment)
        return false;
    for (const Fillet &corner : corners)
        if (in_sliver(corner, p.corner_radius, x, y))
            return false;
    return true;
}

// Lit length of a line along x: steps of a mask pixel, the ends of each run by bisection.
template <class Lit> double lit_length(const Lit &is_lit, double y) {
    double length = 0;
    bool before = false;
    for (double x = -1.2; x < 1.2; x += metres_per_pixel) {
        const double next = x + metres_per_pixel;
        const bool after = is_lit(next, y);
        if (before && after)
            length += metres_per_pixel;
        else if (before != after) {
            double low = x, high = next;
            for (int halving = 0; halving < 20; ++halving) {
                const double middle = (low + high) / 2;
                (is_lit(middle, y) == before ? low : high) = middle;
            }
            length += before ? low - x : next - low;
        }
        before = after;
    }
    return length;
}

TEST(Pupil, StandsInMetresFromTheOpticalAxis) {
    const SegmentedPupil &p = pupil();
    EXPECT_NEAR(p.outer.x, (2048.48748 - 2048) * metres_per_pixel, 1e-15);
    EXPECT_NEAR(p.outer.y, (2046.86613 - 2048) * metres_per_pixel, 1e-15);
    EXPECT_NEAR(p.outer.radius, 847.74080 * metres_per_pixel, 1e-15);
    EXPECT_NEAR(p.obscuration.x, (2013.48160 - 2048) * metres_per_pixel, 1e-15);
    EXPECT_NEAR(p.obscuration.y, (2048.40610 - 2048) * metres_per_pixel, 1e-15);
    EXPECT_NEAR(p.obscuration.radius, 288.03055 * metres_per_pixel, 1e-15);
    EXPECT_NEAR(p.corner_radius, 18.23520 * metres_per_pixel, 1e-15);
    EXPECT_EQ(p.fit_error, 5.9e-6);
    // The mask's lit pixel farthest from the axis, which sets the scale, lies on the outer circle.
    EXPECT_NEAR(std::hypot(p.outer.x, p.outer.y) + p.outer.radius, 1.18, metres_per_pixel);
}

TEST(Pupil, IsOneForAllScasAndBands) {
    for (int sca = 1; sca <= 18; ++sca)
        for (const Band &band : c5().bands)
            EXPECT_EQ(&c5().pupil(sca, band.name), &c5().pupil(7, "H158"));
}

TEST(Pupil, EverySegmentHasFourCornersAndTheirFillets) {
    EXPECT_EQ(fillets(pupil()).size(), 24u);
    for (const auto &[a, b] : pupil().segments) {
        EXPECT_NEAR(std::hypot(a.nx, a.ny), 1, 1e-15);
        EXPECT_NEAR(std::hypot(b.nx, b.ny), 1, 1e-15);
        for (const Circle &circle : {pupil().outer, pupil().obscuration}) {
            double ax, ay, bx, by;
            ASSERT_TRUE(crossing(a, b, 0, circle, circle.radius, ax, ay));
            ASSERT_TRUE(crossing(b, a, 0, circle, circle.radius, bx, by));
            const double centre_x = circle.x, centre_y = circle.y;
            EXPECT_GT((ax - centre_x) * (by - centre_y) - (ay - centre_y) * (bx - centre_x), 0)
                << "not counterclockwise from the first edge to the second";
        }
    }
}

TEST(Pupil, SegmentsFollowEachOtherCounterclockwiseWithStrutsBetween) {
    for (size_t i = 0; i < 6; ++i) {
        const HalfPlane &end = pupil().segments[i].counterclockwise_edge;
        const HalfPlane &begin = pupil().segments[(i + 1) % 6].clockwise_edge;
        // A strut's two edges are nearly parallel and their lit sides face away from each other.
        EXPECT_LT(end.nx * begin.nx + end.ny * begin.ny, -0.99);
    }
}

TEST(Pupil, AreaAgreesWithTheMask) {
    const auto corners = fillets(pupil());
    const auto is_lit = [&](double x, double y) { return lit(pupil(), corners, x, y); };
    const double step = metres_per_pixel / 2;
    double area = 0;
    for (double y = -1.2 + step / 2; y < 1.2; y += step)
        area += step * lit_length(is_lit, y);
    const double mask_area = 1783865 * metres_per_pixel * metres_per_pixel;
    EXPECT_NEAR(area, mask_area, 1e-5 * mask_area);
}

// The mask is lit or unlit pixel by pixel, which alone moves its second moments by 4e-5 of their
// sum: as close as any geometry drawn on its pixels can be held to it.
TEST(Pupil, DrawnOnTheMasksPixelsHasTheMasksMoments) {
    const auto corners = fillets(pupil());
    double n = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0; // pixels from the axis
    for (int row = -860; row <= 860; ++row)
        for (int column = -860; column <= 860; ++column)
            if (lit(pupil(), corners, column * metres_per_pixel, row * metres_per_pixel)) {
                ++n;
                x += column;
                y += row;
                xx += column * column;
                yy += row * row;
                xy += column * row;
            }
    // The same sums over the mask's lit pixels; the tolerances leave room for the few hundred
    // pixels that differ.
    EXPECT_NEAR(n, 1783865, 60);
    EXPECT_NEAR(x / n, -3.3910419, 0.01);
    EXPECT_NEAR(y / n, 0.9254932, 0.01);
    const double sum = (xx + yy) / n, mask_sum = 403661.36592;
    EXPECT_NEAR(sum, mask_sum, 3e-5 * mask_sum);
    EXPECT_NEAR((xx - yy) / n / sum, 0.00359428, 4e-5);
    EXPECT_NEAR(2 * xy / n / sum, -0.00069775, 4e-5);
}

TEST(Pupil, IsTheRightWayUp) {
    // Pixels of the mask, from the axis, that a strut covers but none of whose mirror images is
    // covered: column to the right, row upwards.
    constexpr double covered[][2] = {{260, -700}, {-360, -660}, {-280, -380},
                                     {720, 40},   {400, 560},   {-400, 640}};
    const auto corners = fillets(pupil());
    for (const auto &[column, row] : covered) {
        const double x = column * metres_per_pixel, y = row * metres_per_pixel;
        EXPECT_FALSE(lit(pupil(), corners, x, y)) << column << ' ' << row;
        EXPECT_TRUE(lit(pupil(), corners, -x, y)) << column << ' ' << row;
        EXPECT_TRUE(lit(pupil(), corners, x, -y)) << column << ' ' << row;
        EXPECT_TRUE(lit(pupil(), corners, -x, -y)) << column << ' ' << row;
        EXPECT_TRUE(lit(pupil(), corners, y, x)) << column << ' ' << row;
    }
}

TEST(Pupil, WithoutStrutsIsAnAnnulusAboutTheAxis) {
    EXPECT_DOUBLE_EQ(c5().annular_pupil().outer_radius, 1.18);
    EXPECT_DOUBLE_EQ(c5().annular_pupil().inner_radius, 0.354);
}

} // namespace
} // namespace wfpsf
