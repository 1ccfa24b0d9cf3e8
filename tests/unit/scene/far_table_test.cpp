// SPDX-License-Identifier: GPL-3.0-or-later
// Tabulated far light against far light itself, and against exact PSFs of other places.
#include "scene/far_reach.hpp"
#include "scene/far_table.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

namespace wfpsf {
namespace {

constexpr double radius = 42, floor = 1e-9;
constexpr double nearest = 25; // whole pixels beyond where far light begins
const Region image{0, 0, 4088, 4088};
const Star star{61.3, 80.8, 1};

SceneOptics broadband(const char *band, int sca) {
    return scenes::roman(
        band, {detected_light(Instrument::get("roman-c9").band(band), black_body_sed(5000))}, sca);
}

FarLight far_light(const SceneOptics &optics, double x, double y) {
    return {optics.nearest(x, y), optics.lights[0], probe_settings(optics.settings)};
}

std::vector<FarLight> at_places(const SceneOptics &optics) {
    std::vector<FarLight> lights;
    for (const auto &[x, y] : FarTables::places(image, true))
        lights.push_back(far_light(optics, x, y));
    return lights;
}

// It takes long to make them.
const std::vector<FarLight> &lights_of_j129() {
    static const std::vector<FarLight> lights = at_places(broadband("J129", 7));
    return lights;
}

Psf exact(const SceneOptics &optics, double x, double y, double eps = 1e-6) {
    PsfSettings settings = optics.settings;
    settings.eps = eps;
    settings.radius = radius;
    return std::move(make_psfs(optics.nearest(x, y), {&optics.lights[0], 1}, settings)[0]);
}

// The largest in pixels that tables draw.
double largest_difference(const Plane<double> &a, const Plane<double> &b) {
    double most = 0;
    for (int64_t y = 0; y < a.ny(); ++y)
        for (int64_t x = 0; x < a.nx(); ++x) {
            const double off = std::max(std::abs(static_cast<double>(x) - star.x),
                                        std::abs(static_cast<double>(y) - star.y));
            if (off > nearest && off < radius - 1)
                most = std::max(most, std::abs(a(x, y) - b(x, y)));
        }
    return most;
}

Plane<double> drawn_at(const FarTables &tables, double x, double y) {
    Plane<double> drawn(160, 150);
    tables.add(star, x, y, nearest, floor, drawn.view(), 0, drawn.ny() - 1);
    return drawn;
}

TEST(FarTables, OfFarLightAloneAreThat) {
    const FarLight &light = lights_of_j129()[0];
    const FarTables tables({&light, 1}, nullptr, image, {radius, floor, radius, floor});
    Plane<double> expected(160, 150);
    light.add(star, nearest, floor, expected.view());
    const Plane<double> drawn = drawn_at(tables, -1e9, 3); // the same everywhere
    const double error = largest_difference(drawn, expected);
    EXPECT_LE(error, 2e-3 * light.brightest_beyond(2 * nearest));
    EXPECT_GT(error, 0);
}

// What plans count on: cpp/scene/ways.cpp.
TEST(FarTables, StandForExactPsfsOfAllPlaces) {
    const std::pair edge(100.0, 1000.0), between(3100.0, 3200.0);
    for (const auto &[band, sca, places] :
         {std::tuple("J129", 7, std::vector{edge, between}),
          std::tuple("Z087", 3, std::vector{edge}), std::tuple("H158", 12, std::vector{between})}) {
        const SceneOptics optics = broadband(band, sca);
        const std::vector<FarLight> lights = sca == 7 ? lights_of_j129() : at_places(optics);
        const Psf middle = exact(optics, 2044, 2044);
        const FarTables tables(lights, &middle, image, {radius, floor, radius, floor});
        Plane<double> of_middle(160, 150), edges(160, 150);
        middle.add({&star, 1}, 1, of_middle.view(), 1);
        lights[0].add(star, nearest, floor, edges.view());
        EXPECT_LE(largest_difference(edges, of_middle),
                  0.8 * FarReach(lights[0], 1).error(nearest, 0, 1))
            << band;
        for (const auto &[x, y] : places) {
            Plane<double> truth(160, 150);
            exact(optics, x, y).add({&star, 1}, 1, truth.view(), 1);
            const double error = largest_difference(drawn_at(tables, x, y), truth);
            EXPECT_LE(error, 3e-3 * lights[0].brightest_beyond(nearest)) << band;
            EXPECT_LE(5 * error, largest_difference(of_middle, truth)) << band;
        }
    }
}

// As far off as tables begin they are better than near the core. Plans count on that too.
TEST(FarTables, HoldExactPsfsThatAreBetterThanTheirTolerance) {
    for (const auto &[band, sca] :
         {std::pair("J129", 7), std::pair("W146", 2), std::pair("F184", 16)}) {
        const SceneOptics optics = broadband(band, sca);
        Plane<double> truth(160, 150);
        exact(optics, 2044, 2044, 1e-9).add({&star, 1}, 1, truth.view(), 1);
        const double peak = truth(61, 81);
        for (const double eps : {1e-5, 1e-7}) {
            Plane<double> drawn(160, 150);
            exact(optics, 2044, 2044, eps).add({&star, 1}, 1, drawn.view(), 1);
            const double share = largest_difference(drawn, truth) / (eps * peak);
            EXPECT_LE(share, 0.004) << band << eps;
            EXPECT_GT(share, 0) << band << eps;
        }
    }
}

TEST(FarTables, AreCoarseWhereLittleIsAsked) {
    const FarTables fine(lights_of_j129(), nullptr, image, {radius, floor, radius, floor});
    constexpr double little = 1e-6;
    const FarTables coarse(lights_of_j129(), nullptr, image, {radius, little, radius, little});
    const double error = largest_difference(drawn_at(coarse, 900, 3000), drawn_at(fine, 900, 3000));
    EXPECT_LE(error, 3 * little);
    EXPECT_GT(error, 0.03 * little);
}

TEST(FarTables, TellWhatTheyDraw) {
    const FarLight &light = lights_of_j129()[0];
    const FarTables tables({&light, 1}, nullptr, image, {radius, floor, radius, floor});
    for (const double faint : {1e-6, 1e-8})
        for (const double within : {35.0, 1e9}) {
            Plane<double> drawn(160, 150);
            tables.middle().add(star, nearest + 3, faint, drawn.view(), 0, drawn.ny() - 1);
            double sum = 0;
            for (int64_t y = 0; y < drawn.ny(); ++y)
                for (int64_t x = 0; x < drawn.nx(); ++x)
                    if (std::max(std::abs(static_cast<double>(x) - star.x),
                                 std::abs(static_cast<double>(y) - star.y)) <= within)
                        sum += drawn(x, y);
            EXPECT_NEAR(tables.middle().light(within, nearest + 3, faint), sum, 0.05 * sum);
        }
}

TEST(FarTables, DrawRowsAsTheWholeAndLeaveOutWhatIsFaint) {
    constexpr double wide = 60;
    const FarTables tables(lights_of_j129(), nullptr, image, {wide, floor, wide, floor});
    const Plane<double> whole = drawn_at(tables, 900, 3000);
    Plane<double> rows(160, 150);
    for (int64_t y = 0; y < rows.ny(); y += 7)
        tables.add(star, 900, 3000, nearest, floor, rows.view(), y, std::min(y + 6, rows.ny() - 1));
    constexpr double bright = 1e-6;
    Plane<double> part(160, 150);
    tables.add(star, 900, 3000, nearest, bright, part.view(), 0, part.ny() - 1);
    double left_out = 0, drawn = 0;
    for (int64_t y = 0; y < rows.ny(); ++y)
        for (int64_t x = 0; x < rows.nx(); ++x) {
            ASSERT_EQ(rows(x, y), whole(x, y)) << x << " " << y;
            left_out = std::max(left_out, std::abs(part(x, y) - whole(x, y)));
            drawn = std::max(drawn, part(x, y));
        }
    EXPECT_LE(left_out, 1.2 * bright);
    EXPECT_GT(left_out, 0.1 * bright);
    EXPECT_GT(drawn, 10 * bright);
}

} // namespace
} // namespace wfpsf
