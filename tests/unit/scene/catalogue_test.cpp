// SPDX-License-Identifier: GPL-3.0-or-later
#include "error/error.hpp"
#include "scene/catalogue.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace wfpsf {
namespace {

wfpsf_status status_of(const std::function<void()> &body) {
    try {
        body();
    } catch (const Error &error) {
        return error.status();
    }
    return WFPSF_OK;
}

TEST(Catalogue, KeepsWhatItIsGiven) {
    Catalogue catalogue(PositionKind::detector, BrightnessKind::ab_magnitude);
    catalogue.add_colour({});
    catalogue.add_colour({.wavelength_nm = 1200});
    const double x[] = {1, 2}, y[] = {3, 4}, magnitude[] = {0, 2.5};
    const int32_t colour[] = {1, 0};
    catalogue.add_stars({x, y, magnitude, colour});
    const GalaxyShape shapes[] = {{1, 0.3, 0.1, 0}, {4, 0.5, 0, 0}};
    catalogue.add_galaxies({x, y, magnitude, {}}, shapes);
    const std::vector<PlacedSource> placed = catalogue.placed(nullptr, 1, 1000);
    ASSERT_EQ(placed.size(), 4U);
    EXPECT_EQ(placed[0].colour, 1);
    EXPECT_EQ(placed[0].shape, PlacedSource::star);
    EXPECT_NEAR(placed[1].flux, 100, 1e-10);
    EXPECT_EQ(placed[3].shape, 1);
    EXPECT_EQ(placed[3].colour, 0);
}

TEST(Catalogue, RefusesBadNumbersAndAddsNothing) {
    Catalogue catalogue(PositionKind::sky, BrightnessKind::electrons);
    const double good[] = {1, 2}, nan[] = {1, NAN}, pole[] = {1, 91};
    const int32_t colour[] = {0, 1};
    EXPECT_EQ(status_of([&] {
                  catalogue.add_stars({nan, good, good, {}});
              }),
              WFPSF_ERROR_NOT_FINITE);
    EXPECT_EQ(status_of([&] { catalogue.add_stars({good, pole, good, {}}); }), WFPSF_ERROR_RANGE);
    EXPECT_EQ(status_of([&] {
                  catalogue.add_stars({good, good, good, colour});
              }),
              WFPSF_ERROR_RANGE);
    const GalaxyShape flat[] = {{1, 0.3, 0.7, 0.7}, {1, 0.3, 0, 0}};
    EXPECT_EQ(status_of([&] {
                  catalogue.add_galaxies({good, good, good, {}}, flat);
              }),
              WFPSF_ERROR_RANGE);
    EXPECT_EQ(catalogue.size(), 0U);
    EXPECT_EQ(status_of([&] { (void)catalogue.placed(nullptr, 1, 1); }), WFPSF_ERROR_ARGUMENT);
}

} // namespace
} // namespace wfpsf
