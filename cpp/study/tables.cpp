// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/tables.hpp"

#include "study/paper.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <wfpsf/study.h>

namespace wfpsf {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double mas_per_pixel(const StudySource &source) {
    return 1000 * source.instrument.pixel_scale_arcsec();
}

} // namespace

bool is_papers(const StudySource &source) {
    return source.instrument.name == paper_instrument && source.sca == paper_sca;
}

bool is_shown(const Instrument &instrument, const Band &band) {
    constexpr const char *shown[] = {"J129", "H158", "F184"};
    const auto has = [&](std::string_view name) {
        return std::ranges::any_of(instrument.bands, [&](const Band &b) { return b.name == name; });
    };
    if (!std::ranges::all_of(shown, has))
        return true;
    return std::ranges::any_of(shown, [&](std::string_view name) { return band.name == name; });
}

StudyTable bands_table(const StudySource &source) {
    StudyTable table{{"band", "blue_nm", "red_nm", "effective_nm", "paper_blue_nm", "paper_red_nm",
                      "paper_effective_nm"},
                     {}};
    for (const Band &band : source.instrument.bands) {
        const BandWavelengths own = thinned_wavelengths(band);
        const PaperBand *paper =
            source.instrument.name == paper_instrument ? paper_band(band.name) : nullptr;
        table.add({band.name, own.blue_nm, own.red_nm, own.effective_nm,
                   paper ? paper->blue_nm : nan, paper ? paper->red_nm : nan,
                   paper ? paper->effective_nm : nan});
    }
    return table;
}

StudyTable sizes_table(const StudySource &source, const Stars &stars) {
    StudyTable table{
        {"band", "struts", "ipc", "quantity", "unit", "paper", "value", "error_estimate"}, {}};
    const double mas = mas_per_pixel(source);
    for (const BandStar &s : stars)
        for (const bool ipc : {false, true}) {
            const AdaptiveMoments &m = ipc ? s.nominal : s.bare;
            const Plane<double> image = s.star.image(ipc ? nominal_ipc : Ipc{});
            const StarShape<double> shape = s.star.shape(m);
            const double error = s.error(m);
            const auto add = [&](const char *quantity, bool length, const Estimated &own) {
                const auto [value, numerical] = own;
                const double paper =
                    is_papers(source) && !ipc ? paper_size(s.band.name, s.struts, quantity) : nan;
                table.add({s.band.name, double(s.struts), double(ipc), quantity,
                           length ? "mas" : "1", paper, length ? value * mas : value,
                           length ? (value * error + numerical) * mas : 2 * error});
            };
            add("sigma", true, {shape.sigma});
            add("e1", false, {shape.e1});
            add("e2", false, {shape.e2});
            add("e", false, {m.e()});
            add("ee50_centroid", true, s.half_light(image, m.weight.x, m.weight.y));
            add("ee50_axis", true, s.half_light_axis(image));
        }
    return table;
}

// Each PSF of all detectors, measured by its derivatives at the nominal IPC.
StudyTable requirements_table(StarMaker &maker, const Progress &progress) {
    StudyTable table{{"band", "sca", "struts", "parameter_error", "dsigma_over_sigma",
                      "dtr_over_tr", "de1", "de2", "meets", "largest_alpha", "largest_alpha_prime",
                      "largest_alpha_plus", "largest_all"},
                     {}};
    const StudySource &source = maker.source();
    const PaperRequirement required;
    const int scas = source.instrument.sca_count();
    for (int sca = 1; sca <= scas; ++sca) {
        progress.report((sca - 1.0) / scas);
        for (const Band &band : source.instrument.bands) {
            const double bandwidth = maker.bandwidth(band);
            const int64_t side = IpcStar::sufficient_side(bandwidth);
            const IpcStar star(maker.psf(sca, band, source.struts, static_cast<double>(side) / 2),
                               IpcStar::sufficient_oversampling(bandwidth), side);
            const Plane<double> image = star.image(nominal_ipc);
            const StarSlopes slopes(star, image, solved(star, image, band));
            // The largest errors that each parameter may have alone, and all together; effects add
            // up without their signs.
            double sigma = 0, trace = 0, e1 = 0, e2 = 0;
            const auto largest = [&](double dtrace, double de1, double de2) {
                return std::min({required.allowed_trace / dtrace, required.allowed_e / de1,
                                 required.allowed_e / de2});
            };
            std::vector<StudyCell> alone;
            for (size_t p = 0; p < ipc_parameters; ++p) {
                const StarShape<HyperDual> slope = slopes.along(star.change(p));
                const double dtrace = std::abs(slope.trace.da / slope.trace.value);
                alone.emplace_back(largest(dtrace, std::abs(slope.e1.da), std::abs(slope.e2.da)));
                sigma += std::abs(slope.sigma.da / slope.sigma.value);
                trace += dtrace;
                e1 += std::abs(slope.e1.da);
                e2 += std::abs(slope.e2.da);
            }
            const double all = largest(trace, e1, e2), error = required.error;
            table.add({band.name, double(sca), double(source.struts), error, sigma * error,
                       trace * error, e1 * error, e2 * error, double(all >= error), alone[0],
                       alone[1], alone[2], all});
        }
    }
    return table;
}

StudyTable comparison_table(const StudySource &source, const Study &study) {
    StudyTable table{{"quantity", "parameter", "unit", "band", "struts", "paper", "peer", "value",
                      "paper_off_percent", "reason"},
                     {}};
    if (!is_papers(source))
        return table;
    const auto add = [&](const std::string &quantity, const std::string &parameter,
                         const std::string &unit, const std::string &band, bool struts,
                         double paper, double value) {
        if (std::isnan(paper))
            return;
        const double off = 100 * (paper / value - 1);
        table.add({quantity, parameter, unit, band, double(struts), paper,
                   parameter.empty() ? peer_size(band, struts, quantity) : nan, value, off,
                   std::abs(off) > 1 ? reason_for_difference(quantity, parameter) : ""});
    };
    const auto word = [](const std::vector<StudyCell> &row, size_t i) {
        return std::get<std::string>(row[i]);
    };
    const auto number = [](const std::vector<StudyCell> &row, size_t i) {
        return std::get<double>(row[i]);
    };
    for (const auto &row : study.at(WFPSF_STUDY_SIZES).rows)
        add(word(row, 3), "", word(row, 4), word(row, 0), number(row, 1) != 0, number(row, 5),
            number(row, 6));
    // The paper's coefficients are fitted ones.
    for (const auto &row : study.at(WFPSF_STUDY_SENSITIVITIES).rows)
        add(word(row, 3), word(row, 4), "1", word(row, 0), number(row, 2) != 0, number(row, 5),
            number(row, 7));
    for (const auto &row : study.at(WFPSF_STUDY_REQUIREMENTS).rows)
        if (word(row, 0) == "J129" && number(row, 1) == paper_sca && number(row, 2) != 0) {
            const PaperRequirement paper;
            add("sum_sigma", "all 1e-4", "1", "J129", true, paper.sigma, number(row, 4));
            add("sum_trace", "all 1e-4", "1", "J129", true, paper.trace, number(row, 5));
            add("sum_e1", "all 1e-4", "1", "J129", true, paper.e1, number(row, 6));
        }
    return table;
}

// Against twice as many samples as are sufficient. NaN: no solution at all.
StudyTable convergence_table(const StudySource &source, const Stars &stars) {
    StudyTable table{{"band", "oversampling", "sigma", "e1", "e2", "R_alpha", "R_alpha_prime",
                      "R_alpha_plus", "S1_alpha", "S1_alpha_plus"},
                     {}};
    constexpr int64_t most = 32; // the paper's
    constexpr size_t numbers = 8;
    const auto measured = [](const BandStar &s, int64_t oversampling) {
        std::array<double, numbers> result;
        result.fill(nan);
        const IpcStar star(s.psf, oversampling, IpcStar::sufficient_side(s.bandwidth));
        const Plane<double> image = star.image(nominal_ipc);
        const AdaptiveMoments m = star.measure(image);
        if (m.status < 0 || m.status == WFPSF_WARNING_NOT_CONVERGED)
            return result;
        const StarSlopes slopes(star, image, m);
        std::array<StarShape<HyperDual>, ipc_parameters> by;
        for (size_t p = 0; p < ipc_parameters; ++p)
            by[p] = slopes.along(star.change(p));
        const auto relative = [&](size_t p) { return by[p].sigma.da / by[p].sigma.value; };
        return std::array<double, numbers>{by[0].sigma.value, by[0].e1.value, by[0].e2.value,
                                           relative(0),       relative(1),    relative(2),
                                           by[0].e1.da,       by[2].e1.da};
    };
    for (const BandStar &s : stars) {
        if (s.struts != source.struts || !is_shown(source.instrument, s.band))
            continue;
        const auto truth = measured(s, 2 * s.star.oversampling());
        // From the largest images down, which keep their memory.
        std::array<std::array<double, numbers>, most> by_oversampling;
        for (int64_t oversampling = most; oversampling > 0; --oversampling)
            by_oversampling[static_cast<size_t>(oversampling - 1)] = measured(s, oversampling);
        for (int64_t oversampling = 1; oversampling <= most; ++oversampling) {
            const auto &own = by_oversampling[static_cast<size_t>(oversampling - 1)];
            std::vector<StudyCell> row{s.band.name, static_cast<double>(oversampling)};
            row.emplace_back(std::abs(own[0] / truth[0] - 1));
            for (size_t i = 1; i < numbers; ++i)
                row.emplace_back(std::abs(own[i] - truth[i]));
            table.add(std::move(row));
        }
    }
    return table;
}

} // namespace wfpsf
