// SPDX-License-Identifier: GPL-3.0-or-later
// The study against the converged truth, and against what the paper prints.
#include "csv.hpp"
#include "handles.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <tuple>

namespace {

struct DestroyStudy {
    void operator()(wfpsf_study *study) const { wfpsf_study_destroy(study); }
};
using Study = std::unique_ptr<wfpsf_study, DestroyStudy>;

Study make_study(int32_t sca) {
    const Options options = make_options();
    require(wfpsf_options_set_real(options.get(), WFPSF_OPTION_EPS, 1e-9));
    const Instrument c5 = make_c5();
    wfpsf_study *study = nullptr;
    require(wfpsf_study_create(c5.get(), sca, options.get(), &study));
    return Study(study);
}

std::string text(const Study &study, int32_t table, int64_t row, int64_t column) {
    return wfpsf_study_text(study.get(), table, row, column);
}

double number(const Study &study, int32_t table, int64_t row, int64_t column) {
    double value = 0;
    require(wfpsf_study_value(study.get(), table, row, column, &value));
    return value;
}

int64_t rows(const Study &study, int32_t table) {
    int64_t count = 0;
    require(wfpsf_study_size(study.get(), table, &count, nullptr));
    return count;
}

struct Slope {
    double paper, exact, fit;
};
// By band, struts, quantity and parameter.
using Slopes = std::map<std::tuple<std::string, int, std::string, std::string>, Slope>;

Slopes slopes(const Study &study) {
    constexpr int32_t table = WFPSF_STUDY_SENSITIVITIES;
    Slopes result;
    for (int64_t row = 0; row < rows(study, table); ++row)
        result[{text(study, table, row, 0), static_cast<int>(number(study, table, row, 2)),
                text(study, table, row, 3), text(study, table, row, 4)}] = {
            number(study, table, row, 5), number(study, table, row, 6),
            number(study, table, row, 7)};
    return result;
}

const char *const parameters[][2] = {
    {"alpha", "alpha"}, {"alphap", "alpha_prime"}, {"plus", "alpha_plus"}};

TEST(Study, MeetsTheTruth) {
    std::map<int, Slopes> by_sca;
    int compared = 0;
    for (const Row &row : Table("psf_c5/psf_c5_truth.csv")) {
        const int sca = row.integer("sca");
        if (!by_sca.contains(sca))
            by_sca[sca] = slopes(make_study(sca));
        for (const auto &names : parameters) {
            const char *const column = names[0], *const parameter = names[1];
            const auto own = [&](const char *quantity) {
                return by_sca[sca]
                    .at({row.text("band"), row.integer("struts"), quantity, parameter})
                    .exact;
            };
            SCOPED_TRACE(row.text("band") + ", SCA " + row.text("sca") + ", struts " +
                         row.text("struts") + ", " + parameter);
            EXPECT_NEAR(own("sigma"), row.number(std::string("R_") + column), 1e-4);
            EXPECT_NEAR(own("e1"), row.number(std::string("S1_") + column), 1e-4);
            EXPECT_NEAR(own("e2"), row.number(std::string("S2_") + column), 1e-4);
            compared += 3;
        }
    }
    EXPECT_EQ(compared, 72);
}

// R_alpha and S_1,+ to 1.6 %. The paper's S_1,+ of F184 is 1.9 % off the truth.
TEST(Study, MeetsThePaper) {
    const Slopes own = slopes(make_study(7));
    std::map<std::string, double> true_plus;
    for (const Row &row : Table("psf_c5/psf_c5_truth.csv"))
        if (row.integer("sca") == 7 && row.integer("struts") == 1)
            true_plus[row.text("band")] = row.number("S1_plus");
    for (const Row &row : Table("paper_table3.csv")) {
        const Slope slope = own.at({row.text("band"), 1, "sigma", "alpha"});
        EXPECT_NEAR(slope.fit / row.number("R_alpha_over_sigma"), 1, 0.016) << row.text("band");
    }
    for (const Row &row : Table("paper_table4.csv")) {
        const Slope slope = own.at({row.text("band"), 1, "e1", "alpha_plus"});
        const double off = std::abs(true_plus.at(row.text("band")) / row.number("S1_plus") - 1);
        EXPECT_NEAR(slope.fit / row.number("S1_plus"), 1, std::max(0.016, off)) << row.text("band");
    }
}

// What the tables say that the paper prints.
TEST(Study, HoldsWhatThePaperPrints) {
    const Slopes own = slopes(make_study(7));
    struct Printed {
        const char *column, *quantity, *parameter;
    };
    const auto compare = [&own](const char *file, std::initializer_list<Printed> columns) {
        for (const Row &row : Table(file))
            for (const auto &[column, quantity, parameter] : columns)
                EXPECT_EQ(own.at({row.text("band"), 1, quantity, parameter}).paper,
                          row.number(column))
                    << row.text("band") << ' ' << column;
    };
    compare("paper_table3.csv", {{"R_alpha_over_sigma", "sigma", "alpha"},
                                 {"R_alphaprime_over_sigma", "sigma", "alpha_prime"},
                                 {"S1_alpha", "e1", "alpha"},
                                 {"S1_alphaprime", "e1", "alpha_prime"},
                                 {"S2_alpha", "e2", "alpha"},
                                 {"S2_alphaprime", "e2", "alpha_prime"}});
    compare("paper_table4.csv", {{"R_plus_over_sigma", "sigma", "alpha_plus"},
                                 {"S1_plus", "e1", "alpha_plus"},
                                 {"S2_plus", "e2", "alpha_plus"}});
}

} // namespace
