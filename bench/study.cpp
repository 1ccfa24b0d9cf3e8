// SPDX-License-Identifier: GPL-3.0-or-later
// The whole of the paper in one call. Errors are of the sensitivities to IPC: against those of a
// study with PSFs good to 1e-11, and against converged sums over the published mask, which hold the
// error of the pupil's geometry too.
#include "study/study.hpp"

#include "harness.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <variant>

#include <wfpsf/study.h>

namespace wfpsf::bench {

namespace {

Study study(double eps) {
    const Instrument &c5 = Instrument::get("wfirst-afta-c5");
    const auto wavefront = [&](int sca) {
        const auto own = c5.zernikes(sca);
        std::vector<double> waves(own.begin(), own.end());
        std::fill_n(waves.begin(), 3, 0.0);
        return Wavefront(waves, c5.diameter_m() / 2);
    };
    const double pixel_scale = c5.pixel_scale_arcsec() * std::numbers::pi / 180 / 3600;
    return make_study(
        {c5, 7, true, {c5.reference_wavelength_nm() * 1e-9, pixel_scale, eps, 16}, wavefront});
}

// The largest difference of any derivative by alpha, alpha' or alpha+.
double against_precise(const Study &own) {
    const Study precise = study(1e-11);
    const auto &rows = own.at(WFPSF_STUDY_SENSITIVITIES).rows;
    const auto &truth = precise.at(WFPSF_STUDY_SENSITIVITIES).rows;
    double worst = 0;
    for (size_t i = 0; i < rows.size(); ++i)
        if (std::get<std::string>(rows[i][4]).starts_with("alpha"))
            worst = std::max(
                worst, std::abs(std::get<double>(rows[i][6]) - std::get<double>(truth[i][6])));
    return worst;
}

// Of SCA 7 with struts: R_alpha and S_1,+ of J129, H158 and F184.
double against_mask(const Study &own) {
    constexpr struct {
        const char *band;
        double R_alpha, S1_plus;
    } converged[] = {{"J129", 2.97401945, 4.19691322},
                     {"H158", 2.46760720, 3.79827897},
                     {"F184", 2.03473843, 3.36246628}};
    double worst = 0;
    for (const auto &row : own.at(WFPSF_STUDY_SENSITIVITIES).rows)
        for (const auto &[band, R_alpha, S1_plus] : converged) {
            if (std::get<std::string>(row[0]) != band || std::get<double>(row[2]) == 0)
                continue;
            const auto is = [&](const char *quantity, const char *parameter) {
                return std::get<std::string>(row[3]) == quantity &&
                       std::get<std::string>(row[4]) == parameter;
            };
            const double value = std::get<double>(row[6]);
            if (is("sigma", "alpha"))
                worst = std::max(worst, std::abs(value - R_alpha));
            if (is("e1", "alpha_plus"))
                worst = std::max(worst, std::abs(value - S1_plus));
        }
    return worst;
}

Case study_case(double eps, const char *truth, double (*error)(const Study &)) {
    char name[96];
    std::snprintf(name, sizeof name, "the whole study, eps %.0e", eps);
    return {name, truth, 1, 1e-4, [=] {
                Study own;
                Measured m;
                m.timing = time([&] { own = study(eps); });
                m.error = error(own);
                return m;
            }};
}

} // namespace

std::vector<Case> study_cases() {
    return {study_case(1e-4, "sensitivities, numerical", against_precise),
            study_case(1e-6, "sensitivities, numerical", against_precise),
            study_case(1e-6, "R_alpha and S_1,+ against the mask", against_mask)};
}

} // namespace wfpsf::bench
