// SPDX-License-Identifier: GPL-3.0-or-later
// Half-light radii, FWHM and moment radii against GalSim's. Pixels at equal distance come in no
// fixed order there: anything between its smallest and largest value will do.
#include "csv.hpp"
#include "images.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace {

TEST(Sizes, OfPixelsByDistance) {
    const std::map<std::string, Pixels> images = read_images();
    constexpr double widened = 1e-9;
    for (const Row &row : Table("moments/sizes.csv")) {
        SCOPED_TRACE(row.text("id") + ", " + row.text("centre"));
        const wfpsf_image *image = images.at(row.text("id")).image.get();
        const double x = row.number("x") - 1, y = row.number("y") - 1;
        double hlr = 0, fwhm = 0;
        require(wfpsf_size_ee_radius(image, x, y, 0.5, WFPSF_SIZE_PIXEL_INTERPOLATED, nullptr, &hlr,
                                     nullptr));
        EXPECT_GE(hlr, row.number("hlr_lo") - widened);
        EXPECT_LE(hlr, row.number("hlr_hi") + widened);
        const wfpsf_status status = wfpsf_size_fwhm(image, x, y, &fwhm);
        if (row.has("fwhm")) {
            require(status);
            EXPECT_GE(fwhm, row.number("fwhm_lo") - widened);
            EXPECT_LE(fwhm, row.number("fwhm_hi") + widened);
        } else {
            EXPECT_EQ(status, WFPSF_ERROR_SIZE_NOT_REACHED);
        }
    }
}

TEST(Sizes, MomentRadii) {
    const std::map<std::string, Pixels> images = read_images();
    for (const Row &row : Table("moments/sizes.csv")) {
        SCOPED_TRACE(row.text("id") + ", " + row.text("centre"));
        const Ellipse m =
            measure_unweighted(images.at(row.text("id")), row.number("x") - 1, row.number("y") - 1);
        const double trace = std::sqrt((m.Mxx + m.Myy) / 2);
        EXPECT_NEAR(trace, row.number("radius_trace"), 1e-12 * trace);
        EXPECT_NEAR(m.sigma, row.number("radius_det"), 1e-12 * m.sigma);
    }
}

} // namespace
