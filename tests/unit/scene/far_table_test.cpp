// SPDX-License-Identifier: GPL-3.0-or-later
// Tabulated far light against that of each star's own place.
#include "scene/far_table.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

namespace wfpsf {
namespace {

constexpr double radius = 100, floor = 1e-9;
constexpr double nearest = 25; // whole pixels beyond where far light begins

Plane<double> drawn_from(const FarTable &table, const Star &star) {
    Plane<double> image(160, 150);
    table.add(star, nearest, 10 * floor, image.view(), 0, image.ny() - 1);
    return image;
}

Plane<double> drawn_from(const FarLight &light, const Star &star) {
    Plane<double> image(160, 150);
    light.add(star, nearest, star.flux * floor, image.view());
    return image;
}

// Beyond the table's end nothing is drawn.
double largest_difference(const Plane<double> &a, const Plane<double> &b, const Star &star) {
    double most = 0;
    for (int64_t y = 0; y < a.ny(); ++y)
        for (int64_t x = 0; x < a.nx(); ++x)
            if (std::abs(static_cast<double>(x) - star.x) < radius &&
                std::abs(static_cast<double>(y) - star.y) < radius)
                most = std::max(most, std::abs(a(x, y) - b(x, y)));
    return most;
}

const Star star{61.3, 80.8, 1e6};

SceneOptics broadband() {
    return scenes::roman(
        "J129", {detected_light(Instrument::get("roman-c9").band("J129"), black_body_sed(5000))});
}

TEST(FarTable, IsTheFarLight) {
    const SceneOptics optics = broadband();
    const FarLight light(optics.middle(), optics.lights[0], probe_settings(optics.settings));
    const double error = largest_difference(drawn_from(FarTable(light, radius, floor), star),
                                            drawn_from(light, star), star);
    EXPECT_LE(error, 0.02 * star.flux * light.brightest_beyond(2 * nearest));
    EXPECT_GT(error, 0);
}

// Half way between corners mixing errs most.
TEST(FarTables, StandForAllPlacesOfAnImage) {
    const SceneOptics optics = broadband();
    const PsfSettings settings = probe_settings(optics.settings);
    const Region image{0, 0, 4088, 4088};
    std::vector<FarTable> corners;
    for (const auto &[x, y] : FarTables::corners(image))
        corners.emplace_back(FarLight(optics.at(x, y), optics.lights[0], settings), radius, floor);
    const FarTables tables(corners, image);
    EXPECT_EQ(tables.cells(), 64u);
    for (const auto &[x, y] : {std::pair(2044.0, 2044.0), std::pair(10.0, 3500.0)}) {
        const FarLight truth(optics.at(x, y), optics.lights[0], settings);
        const Plane<double> expected = drawn_from(truth, star);
        const double brightest = star.flux * truth.brightest_beyond(2 * nearest);
        const double error = largest_difference(
            drawn_from(tables.of_cell(tables.cell_of(x, y)), star), expected, star);
        EXPECT_LE(error, 0.04 * brightest);
        const double unmixed = largest_difference(drawn_from(corners[0], star), expected, star);
        EXPECT_LT(2 * error, unmixed); // it helps
    }
}

TEST(FarTables, OneIsTheSameEverywhere) {
    const SceneOptics optics = broadband();
    const FarLight light(optics.middle(), optics.lights[0], probe_settings(optics.settings));
    const FarTables tables({FarTable(light, radius, floor)}, {0, 0, 100, 100});
    EXPECT_EQ(tables.cells(), 1u);
    EXPECT_EQ(tables.cell_of(1e9, -1e9), 0u);
    EXPECT_EQ(largest_difference(drawn_from(tables.of_cell(0), star),
                                 drawn_from(FarTable(light, radius, floor), star), star),
              0);
}

} // namespace
} // namespace wfpsf
