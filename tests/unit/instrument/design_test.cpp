// SPDX-License-Identifier: GPL-3.0-or-later
#include "expect_failure.hpp"
#include "instrument/design.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace wfpsf {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Design sound() {
    Design design;
    design.set_telescope(2.4, 0.33, 633);
    design.set_detector(3, 0.04, {101, 51});
    return design;
}

TEST(Design, BecomesAnInstrumentOfItsOwn) {
    std::optional<Design> design(sound());
    design->add_strut(90, 0.03, 0.1);
    design->add_strut(0, 0, 0);
    design->add_band("V", 500, 10, std::vector<double>{0, 0.5, 1.0});
    design->set_zernikes(2, std::vector<double>{0, 0, 0, 0.1});
    const auto instrument = design->instrument();
    design.reset();

    EXPECT_EQ(instrument->diameter_m(), 2.4);
    EXPECT_EQ(instrument->obscuration(), 0.33);
    EXPECT_EQ(instrument->reference_wavelength_nm(), 633);
    EXPECT_EQ(instrument->sca_count(), 3);
    EXPECT_EQ(instrument->constant("n_pix").value, 101);
    EXPECT_EQ(instrument->constant("n_pix_y").value, 51);
    EXPECT_EQ(instrument->constant("zernike_jmax").value, 4);
    EXPECT_FALSE(instrument->ipc_kernel);

    const auto &pupil = std::get<SpiderPupil>(instrument->pupil(3, "V"));
    EXPECT_EQ(pupil.outer_radius, 1.2);
    EXPECT_DOUBLE_EQ(pupil.inner_radius, 1.2 * 0.33);
    ASSERT_EQ(pupil.struts.size(), 1u);
    // Up along y, off towards -x.
    const Strut &strut = pupil.struts[0];
    EXPECT_NEAR(strut.nx * strut.offset, -0.1, 1e-15);
    EXPECT_NEAR(-strut.ny, 0, 1e-15);
    EXPECT_NEAR(strut.nx, 1, 1e-15);

    EXPECT_TRUE(instrument->zernikes(1).empty());
    EXPECT_EQ(instrument->zernikes(2, 612, 562), (std::vector<double>{0, 0, 0, 0.1}));
    expect_failure([&] { instrument->zernikes(2, 613, 0); }, WFPSF_ERROR_RANGE, "x_pix = 613");
    expect_failure([&] { instrument->zernikes(2, 0, 563); }, WFPSF_ERROR_RANGE, "y_pix = 563");
}

TEST(Design, BandsMayEndInAnything) {
    Design design = sound();
    design.add_band("open", 500, 100, std::vector<double>{0.5, 1.0});
    design.add_band("padded", 400, 100, std::vector<double>{0, 0, 0, 1, 0, 0});
    design.add_band("half", 500, 100, std::vector<double>{0, 0, 0.4});
    const auto made = design.instrument();
    const Band &open = made->band("open"), &padded = made->band("padded");
    for (const auto &[wavelength, value] :
         {std::pair(499.9, 0.0), {500, 0.5}, {550, 0.75}, {600, 1}, {600.1, 0}})
        EXPECT_DOUBLE_EQ(throughput(open, wavelength), value) << wavelength;
    // Mean wavelength of t = 0.5 + 0.5 u over u in 0..1: (1/4 + 1/6) / (3/4).
    EXPECT_NEAR(tabulated_wavelengths(open).effective_nm, 500 + 100 * (5.0 / 12) / 0.75, 1e-10);
    EXPECT_EQ(tabulated_wavelengths(open).red_nm, 600);
    EXPECT_EQ(thinned_samples(open), (std::vector<size_t>{0, 1}));
    EXPECT_EQ(tabulated_wavelengths(padded).blue_nm, 600);
    EXPECT_EQ(tabulated_wavelengths(padded).red_nm, 800);
    EXPECT_EQ(tabulated_wavelengths(padded).effective_nm, 700);
    EXPECT_EQ(throughput(padded, 650), 0.5);
    EXPECT_EQ(made->band("half").throughput.size(), 2u);
    for (const Band &band : made->bands) {
        const BandWavelengths w = thinned_wavelengths(band);
        EXPECT_TRUE(w.blue_nm < w.effective_nm && w.effective_nm <= w.red_nm) << band.name;
    }
}

TEST(Design, FieldPointsAreMetAndServeEverySca) {
    Design design = sound();
    const std::array<double, 5> x{50, 100, 0, 0, 100}, y{25, 50, 50, 0, 0};
    std::vector<double> coefficients;
    for (int i = 0; i < 5; ++i)
        coefficients.insert(coefficients.end(), {0.1 * i, -0.2 * i * i});
    design.set_zernikes(2, x, y, coefficients);
    const auto made = design.instrument();
    for (size_t i = 0; i < 5; ++i) {
        const auto here = made->zernikes(2, x[i], y[i]);
        EXPECT_NEAR(here[0], coefficients[2 * i], 1e-14);
        EXPECT_NEAR(here[1], coefficients[2 * i + 1], 1e-14);
    }
    EXPECT_TRUE(made->zernikes(1, 3, 4).empty());

    // One towards each corner, about a centre.
    const auto refused = [&](std::array<double, 5> px, std::array<double, 5> py) {
        expect_failure([&] { design.set_zernikes(1, px, py, coefficients); }, WFPSF_ERROR_ARGUMENT,
                       "field points: ");
    };
    refused({50, 100, 0, 0, 0}, y);
    refused({7, 7, 7, 7, 7}, {7, 7, 7, 7, 7});
    refused({0, 100, 0, 0, 100}, {0, 50, 50, 0, 0});
    refused(x, {25, 25, 25, 25, 25});
    expect_failure(
        [&] {
            design.set_zernikes(1, x, std::array<double, 5>{25, 50, nan, 0, 0}, coefficients);
        },
        WFPSF_ERROR_NOT_FINITE, "y_pix[2] = nan");

    design.set_zernikes(3, std::vector<double>{0.1});
    expect_failure([&] { design.instrument(); }, WFPSF_ERROR_ARGUMENT,
                   "zernikes of sca = 3: at 1 field points, those of others at 5");
}

TEST(Design, IsNotMadeOfParts) {
    expect_failure([] { Design().instrument(); }, WFPSF_ERROR_ARGUMENT, "design: the telescope");
    Design design;
    design.set_telescope(2.4, 0, 633);
    expect_failure([&] { design.instrument(); }, WFPSF_ERROR_ARGUMENT, "design: the detector");
    design = sound();
    design.set_zernikes(4, {});
    expect_failure([&] { design.instrument(); }, WFPSF_ERROR_RANGE, "zernikes of sca = 4: there");
}

} // namespace
} // namespace wfpsf
