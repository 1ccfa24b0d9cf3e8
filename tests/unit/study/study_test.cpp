// SPDX-License-Identifier: GPL-3.0-or-later
// Whole studies: what is in them, and whether their error estimates hold.
#include "c5_star.hpp"
#include "error/error.hpp"
#include "study/band_star.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include <wfpsf/study.h>

namespace wfpsf {
namespace {

double number(const StudyTable &table, size_t row, const std::string &column) {
    const auto at = std::ranges::find(table.columns, column) - table.columns.begin();
    return std::get<double>(table.rows[row].at(static_cast<size_t>(at)));
}

TEST(Study, HasEveryTableWhole) {
    const Study study = make_study(c5_source(1e-4));
    constexpr int32_t keys[] = {
#define WFPSF_KEY(name, key, file, text) key,
        WFPSF_STUDY_TABLE_LIST(WFPSF_KEY)
#undef WFPSF_KEY
    };
    EXPECT_EQ(study.size(), std::size(keys));
    for (const int32_t key : keys) {
        SCOPED_TRACE(study_file(key));
        EXPECT_FALSE(study_file(key).empty());
        const StudyTable &table = study.at(key);
        EXPECT_FALSE(table.rows.empty());
        for (const auto &row : table.rows)
            EXPECT_EQ(row.size(), table.columns.size());
    }
    EXPECT_EQ(study_file(7), "");
    EXPECT_EQ(study.at(WFPSF_STUDY_REQUIREMENTS).rows.size(), 18u * 6);
    EXPECT_EQ(study.at(WFPSF_STUDY_SIZES).rows.size(), 6u * 2 * 2 * 6);
    EXPECT_EQ(study.at(WFPSF_STUDY_FIGURE_3).rows.size(), 121u);
    // The paper's 18 sizes of Table 2, 36 coefficients (R_alpha and S_alpha once) and 3 sums.
    EXPECT_EQ(study.at(WFPSF_STUDY_COMPARISON).rows.size(), 18u + 27 + 3);
}

TEST(Study, ErrorEstimatesHold) {
    const Study truth = make_study(c5_source(1e-10));
    for (const double eps : {1e-3, 1e-5, 1e-7}) {
        SCOPED_TRACE(eps);
        const Study study = make_study(c5_source(eps));
        for (const int32_t key : {WFPSF_STUDY_SIZES, WFPSF_STUDY_SENSITIVITIES}) {
            const StudyTable &own = study.at(key), &exact = truth.at(key);
            ASSERT_EQ(own.rows.size(), exact.rows.size());
            for (size_t i = 0; i < own.rows.size(); ++i)
                EXPECT_LE(std::abs(number(own, i, "value") - number(exact, i, "value")),
                          number(own, i, "error_estimate"))
                    << study_file(key) << " row " << i;
        }
    }
}

// Of all of the grid's points, most of which are interpolated.
TEST(Study, FigureOfHalfLightIsThatOfItsImages) {
    const StudySource source = c5_source(1e-6);
    const StudyTable table = make_study(source).at(WFPSF_STUDY_FIGURE_4);
    StarMaker maker(source);
    const BandStar s(maker, c5().band("J129"), true);
    const auto ee50 = [&s](const Ipc &ipc) {
        const Plane<double> image = s.star.image(ipc);
        const Gaussian w = solved(s.star, image, s.band).weight;
        return s.half_light(image, w.x, w.y).value;
    };
    const double from = ee50({});
    for (size_t i = 0; i < table.rows.size(); i += 3) {
        const Ipc ipc{number(table, i, "alpha"), number(table, i, "alpha_prime")};
        EXPECT_NEAR(number(table, i, "J129"), 100 * (ee50(ipc) / from - 1), 1e-6);
    }
}

// Against central differences of whole measurements, extrapolated, of half-light radii to 1e-12.
TEST(Study, SlopesOfHalfLight) {
    const StudySource source = c5_source(1e-9);
    StarMaker maker(source);
    for (const bool struts : {true, false}) {
        const BandStar s(maker, c5().band("J129"), struts);
        const HalfLightSlopes slopes(s);
        const StarSlopes moments(s.star, s.image, s.nominal);
        double Ipc::*const members[] = {&Ipc::alpha, &Ipc::alpha_prime, &Ipc::alpha_plus};
        for (size_t p = 0; p < ipc_parameters; ++p) {
            const auto ee50 = [&](double change) {
                Ipc ipc = nominal_ipc;
                ipc.*members[p] += change;
                const Plane<double> image = s.star.image(ipc);
                const Gaussian w = solved(s.star, image, s.band).weight;
                return encircled_radius(image.view(), w.x, w.y, 0.5, s.light[0], s.encircled(1e-12))
                    .value;
            };
            const auto slope = [&](double h) { return (ee50(h) - ee50(-h)) / (2 * h) / ee50(0); };
            const auto change = s.star.change(p);
            EXPECT_NEAR(slopes.along(change, moments.along(change)),
                        (4 * slope(1e-3) - slope(2e-3)) / 3, 2e-6);
        }
    }
}

// By aberrations and blur, against stars that are made anew, and about the axis by IPC twice.
TEST(Study, SlopesOfHalfLightByWhatChangesTheStar) {
    const auto star = [](size_t j, double more, double blur) {
        StudySource source = c5_source(1e-9);
        source.settings.blur = {blur, 0, blur};
        source.wavefront = [=](int of) { return c5_wavefront(of, j, more); };
        StarMaker maker(source);
        return BandStar(maker, c5().band("J129"), true);
    };
    const auto ee50 = [](const BandStar &s) {
        const Gaussian &w = s.nominal.weight;
        return encircled_radius(s.image.view(), w.x, w.y, 0.5, s.light[0], s.encircled(1e-11))
            .value;
    };
    const BandStar s = star(4, 0, 0.01);
    const double own = ee50(s);
    const HalfLightSlopes slopes(s);
    const StarSlopes moments(s.star, s.image, s.nominal);
    const auto changes = zernike_changes(s.psf, s.star, c5().diameter_m() / 2, 4, 11);
    for (const size_t j : {4, 5, 8, 11}) {
        const Plane<double> change = changes[j - 4].star.image(nominal_ipc);
        const auto difference = [&](double h) {
            return (ee50(star(j, h, 0.01)) - ee50(star(j, -h, 0.01))) / (2 * h) / own;
        };
        EXPECT_NEAR(slopes.along(change.view(), moments.along(change.view()), changes[j - 4].light),
                    (4 * difference(1e-3) - difference(2e-3)) / 3, 1e-5)
            << "Z" << j;
    }
    const auto by_blur = [&](double h) {
        return (ee50(star(4, 0, 0.01 + h)) - ee50(star(4, 0, 0.01 - h))) / (2 * h) / own;
    };
    EXPECT_NEAR(slopes.along_blur(moments.along_blur({1, 0, 1})),
                (4 * by_blur(1e-3) - by_blur(2e-3)) / 3, 1e-4);

    const AxisHalfLight about_axis(s);
    double Ipc::*const members[] = {&Ipc::alpha, &Ipc::alpha_prime, &Ipc::alpha_plus};
    for (size_t p = 0; p < ipc_parameters; ++p) {
        const auto by_ipc = [&](double change) {
            Ipc ipc = nominal_ipc;
            ipc.*members[p] += change;
            const double centre = s.star.centre();
            const Plane<double> image = s.star.image(ipc);
            return encircled_radius(image.view(), centre, centre, 0.5, s.light[0],
                                    s.encircled(1e-12))
                .value;
        };
        const double middle = by_ipc(0);
        const auto second = [&](double h) {
            return (by_ipc(h) - 2 * middle + by_ipc(-h)) / (h * h) / middle;
        };
        const AxisHalfLight::Slope slope = about_axis.along(s.star.change(p));
        EXPECT_NEAR(slope.first, (by_ipc(1e-4) - by_ipc(-1e-4)) / 2e-4 / middle, 1e-5);
        EXPECT_NEAR(slope.second, (4 * second(1e-3) - second(2e-3)) / 3, 1e-4);
    }
}

// Errors as large as the table allows just meet the requirements.
TEST(Study, LargestErrorsMeetTheRequirements) {
    const StudyTable table = make_study(c5_source(1e-5)).at(WFPSF_STUDY_REQUIREMENTS);
    for (size_t i = 0; i < table.rows.size(); ++i) {
        const double scale = number(table, i, "largest_all") / number(table, i, "parameter_error");
        const double share = std::max({scale * number(table, i, "dtr_over_tr") / 9.3e-4,
                                       scale * number(table, i, "de1") / 4.7e-4,
                                       scale * number(table, i, "de2") / 4.7e-4});
        EXPECT_NEAR(share, 1, 1e-12);
        EXPECT_GT(number(table, i, "largest_alpha"), number(table, i, "largest_all"));
    }
}

// From N = 3 on the errors are those of the PSF.
TEST(Study, ConvergesWithOversampling) {
    const StudyTable table = make_study(c5_source(1e-9)).at(WFPSF_STUDY_CONVERGENCE);
    for (size_t i = 0; i < table.rows.size(); ++i)
        if (number(table, i, "oversampling") >= 4) {
            EXPECT_LE(number(table, i, "sigma"), 1e-9);
            EXPECT_LE(number(table, i, "R_alpha"), 1e-8);
            EXPECT_LE(number(table, i, "S1_alpha_plus"), 1e-8);
        }
}

TEST(Study, OtherDetectorsAndInstrumentsHaveNoPaper) {
    EXPECT_TRUE(make_study(c5_source(1e-3, 4)).at(WFPSF_STUDY_COMPARISON).rows.empty());
}

TEST(Study, StopsWhenAsked) {
    StudySource source = c5_source(1e-3);
    source.manners.progress.go_on = [](double part) { return part < 0.8; };
    try {
        make_study(source);
        FAIL();
    } catch (const Error &error) {
        EXPECT_EQ(error.status(), WFPSF_ERROR_CANCELLED);
    }
    source.manners = {.memory_limit = 1000};
    EXPECT_THROW(make_study(source), Error);
}

} // namespace
} // namespace wfpsf
