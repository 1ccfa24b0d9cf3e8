// SPDX-License-Identifier: GPL-3.0-or-later
#include "instrument/instrument.hpp"
#include "optics/psf.hpp"
#include "optics/pupil_raster.hpp"
#include "optics/roman_region.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace wfpsf {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double pixel_scale = 0.11 * pi / 180 / 3600;

struct Case {
    std::string name;
    std::vector<LitPart> parts;
    std::shared_ptr<const Aperture> aperture;
};

std::vector<Case> cases() {
    const Instrument &c5 = Instrument::get("wfirst-afta-c5");
    const Instrument &roman = Instrument::get("roman-c9");
    const auto &segments = std::get<SegmentedPupil>(c5.pupil(7, "J129"));
    std::vector<Case> all{
        {"C5", lit_parts(segments), make_aperture(segments)},
        {"annulus", lit_parts(c5.annular_pupil()), make_aperture(c5.annular_pupil())}};
    for (const char *band : {"H158", "F184"})
        for (const int sca : {3, 18}) {
            const auto &pupil = std::get<RomanPupil>(roman.pupil(sca, band));
            all.push_back(
                {band + std::to_string(sca), lit_parts(lit_region(pupil)), make_aperture(pupil)});
        }
    return all;
}

double sum(const PupilRaster &raster) {
    double total = 0;
    for (int64_t y = 0; y < raster.lit.ny(); ++y)
        for (int64_t x = 0; x < raster.lit.nx(); ++x)
            total += raster.lit(x, y);
    return total * raster.scale * raster.scale;
}

TEST(PupilRaster, HoldsTheLitAreaOfTheQuadrature) {
    for (const Case &c : cases())
        for (const int64_t n : {1, 2, 17, 64, 301})
            EXPECT_NEAR(sum(raster(c.parts, n, n)), c.aperture->area(), 1e-9) << c.name << ' ' << n;
}

// A fine raster summed over blocks is a coarse one, pixel by pixel.
TEST(PupilRaster, BlocksOfPixelsAddUp) {
    for (const Case &c : cases()) {
        const PupilRaster coarse = raster(c.parts, 50, 63), fine = raster(c.parts, 350, 441);
        EXPECT_NEAR(fine.axis_x, (coarse.axis_x + 0.5) * 7 - 0.5, 1e-9);
        double worst = 0;
        for (int64_t y = 0; y < coarse.lit.ny(); ++y)
            for (int64_t x = 0; x < coarse.lit.nx(); ++x) {
                double block = 0;
                for (int64_t i = 0; i < 49; ++i)
                    block += fine.lit(7 * x + i % 7, 7 * y + i / 7) / 49;
                worst = std::max(worst, std::abs(block - coarse.lit(x, y)));
            }
        EXPECT_LT(worst, 1e-7) << c.name;
    }
}

// The two engine paths: quadrature nodes and nonuniform FFT, area-weighted mask and chirp
// transform. The mask's error falls as the square of its pixel.
TEST(PupilRaster, BothEnginePathsAgree) {
    for (const Case &c : cases())
        for (const double waves : {0.0, 0.15}) {
            const double wavelength = c.name.starts_with("F184") ? 1837e-9 : 1292e-9;
            const Wavefront wavefront(
                std::vector<double>{0, 0, 0, waves, -waves / 2, waves / 3, waves / 4, -waves / 5},
                1.18);
            const PsfSettings settings{wavelength, pixel_scale, 1e-9, 8};
            const auto drawn = [&](const std::shared_ptr<const Aperture> &aperture) {
                Plane<double> stamp(33, 33);
                Psf(aperture, wavefront, settings).draw({15.8, 16.3, 1}, 2, stamp.view());
                return stamp;
            };
            const Plane<double> truth = drawn(c.aperture);
            double before = 0;
            for (const int64_t n : {64, 128, 256, 512}) {
                const PupilRaster mask = raster(c.parts, n, n);
                const Plane<double> stamp =
                    drawn(make_aperture(mask.lit.view(), mask.scale, mask.axis_x, mask.axis_y));
                double worst = 0, peak = 0;
                for (int64_t y = 0; y < stamp.ny(); ++y)
                    for (int64_t x = 0; x < stamp.nx(); ++x) {
                        worst = std::max(worst, std::abs(stamp(x, y) - truth(x, y)));
                        peak = std::max(peak, truth(x, y));
                    }
                const double in_64ths = static_cast<double>(n) / 64;
                EXPECT_LT(worst / peak, (waves == 0 ? 4e-4 : 1.6e-3) / (in_64ths * in_64ths))
                    << c.name << ' ' << waves << ' ' << n;
                if (n > 64) {
                    EXPECT_NEAR(before / worst, 4, 0.3) << c.name << ' ' << waves << ' ' << n;
                }
                before = worst;
            }
        }
}

} // namespace
} // namespace wfpsf
