// SPDX-License-Identifier: GPL-3.0-or-later
// The paper's grids of IPC parameters: its figures, and the laws fitted to them.
#include "study/linear_fit.hpp"
#include "study/paper.hpp"
#include "study/tables.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include <wfpsf/study.h>

namespace wfpsf {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Two parameters that vary about the nominal IPC, and how far.
struct GridAxes {
    double Ipc::*second; // beside alpha
    double half_a, half_b;
    Ipc (*at)(double a, double b);
};

Ipc by_alpha_prime(double a, double b) {
    return {nominal_ipc.alpha + a, nominal_ipc.alpha_prime + b, 0};
}

// Figures 9 to 11 and Table 3.
const GridAxes isotropic{&Ipc::alpha_prime, 5e-3, 5e-4, by_alpha_prime};

// Table 4: alpha_x = alpha + alpha+ and alpha_y = alpha - alpha+, from 0.015 to 0.025.
const GridAxes anisotropic{
    &Ipc::alpha_plus, 5e-3, 5e-3, [](double x, double y) {
        return Ipc{nominal_ipc.alpha + (x + y) / 2, nominal_ipc.alpha_prime, (x - y) / 2};
    }};

// Figures 3 to 6, and 7 and 8: the text leaves the ranges open. These have the nominal IPC in their
// middle, and alpha+ as far as e1 changes by 1e-2, which the text gives.
const GridAxes figure_isotropic{&Ipc::alpha_prime, 0.02, 0.002, by_alpha_prime};
const GridAxes figure_anisotropic{&Ipc::alpha_plus, 0.02, 0.0025, [](double a, double b) {
                                      return Ipc{nominal_ipc.alpha + a, nominal_ipc.alpha_prime, b};
                                  }};

struct Place {
    Ipc ipc;
    StarShape<double> shape;
    double ee50 = nan; // about the centroid
};

Place measured(const BandStar &s, const Ipc &ipc, bool with_half_light) {
    const Plane<double> image = s.star.image(ipc);
    const AdaptiveMoments m = solved(s.star, image, s.band, s.nominal.weight);
    Place place{ipc, s.star.shape(m)};
    if (with_half_light)
        place.ee50 = s.half_light(image, m.weight.x, m.weight.y).value;
    return place;
}

// EE50 takes most of the time and is smooth: it is measured at some of the points. What lies
// between is good to 1e-7 of the change over the grid.
std::vector<Place> measured(const BandStar &s, const GridAxes &axes, bool with_half_light) {
    const auto at = [&](size_t i, size_t j) {
        return axes.at(grid_value(i, axes.half_a), grid_value(j, axes.half_b));
    };
    std::vector<Place> places;
    for (size_t j = 0; j < grid_side; ++j)
        for (size_t i = 0; i < grid_side; ++i)
            places.push_back(measured(s, at(i, j), false));
    if (!with_half_light)
        return places;
    GridNodes nodes;
    for (size_t row = 0; row < grid_nodes.size(); ++row)
        for (size_t column = 0; column < grid_nodes.size(); ++column)
            nodes[row][column] = measured(s, at(grid_nodes[column], grid_nodes[row]), true).ee50;
    for (size_t j = 0; j < grid_side; ++j)
        for (size_t i = 0; i < grid_side; ++i)
            places[j * grid_side + i].ee50 = interpolate_grid(nodes, i, j);
    return places;
}

struct Quantity {
    const char *name;
    bool is_size; // followed relative to its nominal value
    std::function<double(const Place &)> of;
};

const Quantity quantities[] = {{"sigma", true, [](const Place &p) { return p.shape.sigma; }},
                               {"e1", false, [](const Place &p) { return p.shape.e1; }},
                               {"e2", false, [](const Place &p) { return p.shape.e2; }},
                               {"ee50_centroid", true, [](const Place &p) { return p.ee50; }}};

std::vector<GridPoint> changes(const std::vector<Place> &places, double Ipc::*second,
                               const Quantity &quantity) {
    const double nominal = quantity.of(places[places.size() / 2]);
    std::vector<GridPoint> points;
    for (const Place &p : places) {
        const double change = quantity.of(p) - nominal;
        points.push_back({p.ipc.alpha - nominal_ipc.alpha, p.ipc.*second - nominal_ipc.*second,
                          quantity.is_size ? change / nominal : change});
    }
    return points;
}

struct Slope {
    double first = nan, second = nan;
};

// Of sigma, e1 or e2; sizes relative to their own.
Slope slope_of(const StarShape<HyperDual> &shape, std::string_view quantity) {
    const HyperDual number = quantity == "sigma" ? shape.sigma
                             : quantity == "e1"  ? shape.e1
                                                 : shape.e2;
    const double unit = quantity == "sigma" ? shape.sigma.value : 1;
    return {number.da / unit, number.dab / unit};
}

// The derivatives of one star, and the laws of its grids.
class StarReport {
  public:
    StarReport(const StudySource &source, const BandStar &star, StudyTable &slopes,
               StudyTable &laws)
        : source_(source), s_(star), slopes_(slopes), laws_(laws),
          exact_(star.star, star.image, star.nominal), half_light_(star) {
        const char *const names[] = {"alpha", "alpha_prime", "alpha_plus"};
        for (size_t p = 0; p < ipc_parameters; ++p) {
            const StarShape<HyperDual> shape = exact_.along(star.star.change(p));
            for (size_t q = 0; q < 3; ++q)
                by_ipc_[q][p] = slope_of(shape, quantities[q].name);
            by_ipc_[3][p].first = half_light_.along(star.star.change(p), shape);
        }
        const std::vector<Place> iso =
            measured(star, isotropic, is_shown(source.instrument, star.band));
        const std::vector<Place> aniso = measured(star, anisotropic, false);
        for (size_t q = 0; q < std::size(quantities); ++q) {
            const auto fit = add_law("isotropic", isotropic, q, iso);
            const auto fit_plus = add_law("anisotropic", anisotropic, q, aniso);
            const double fits[] = {fit[0], fit[1], fit_plus[1]};
            for (size_t p = 0; p < ipc_parameters; ++p)
                add(quantities[q].name, names[p], by_ipc_[q][p], fits[p]);
        }
        const AxisHalfLight about_axis(star);
        for (size_t p = 0; p < ipc_parameters; ++p) {
            const AxisHalfLight::Slope slope = about_axis.along(star.star.change(p));
            add("ee50_axis", names[p], {slope.first, slope.second}, nan);
        }
    }

    void add(const char *quantity, const std::string &parameter, const Slope &slope, double fit) {
        const double paper = is_papers(source_) && s_.struts
                                 ? paper_sensitivity(s_.band.name, quantity, parameter)
                                 : nan;
        slopes_.add({s_.band.name, double(source_.sca), double(s_.struts), quantity, parameter,
                     paper, slope.first, fit, error(slope.first), slope.second});
    }

    void add_blur() {
        const double scale = source_.instrument.pixel_scale_arcsec();
        const double per_arcsec2 = 1 / (scale * scale);
        const struct {
            const char *parameter;
            Covariance variance;
        } blurs[] = {{"jitter_xx", {per_arcsec2, 0, 0}},
                     {"jitter_xy", {0, per_arcsec2, 0}},
                     {"jitter_yy", {0, 0, per_arcsec2}},
                     {"jitter_variance", {per_arcsec2, 0, per_arcsec2}},
                     {"diffusion_variance", {1, 0, 1}}};
        for (const auto &[parameter, variance] : blurs) {
            const StarShape<HyperDual> shape = exact_.along_blur(variance);
            add_all(parameter, shape);
            if (variance.xy == 0 && variance.xx == variance.yy) {
                const double unit = variance.xx;
                StarShape<HyperDual> per_pixel2 = shape;
                per_pixel2.x.da /= unit;
                per_pixel2.y.da /= unit;
                add("ee50_centroid", parameter, {unit * half_light_.along_blur(per_pixel2), nan},
                    nan);
            }
        }
    }

    // Z4 to the last term that the instrument has, Z11 at least; per wave.
    void add_zernikes() {
        constexpr size_t first = 4, least = 11;
        const size_t last = std::max(least, source_.instrument.zernikes(source_.sca).size());
        size_t j = first;
        for (const auto &[star, light] :
             zernike_changes(s_.psf, s_.star, source_.instrument.diameter_m() / 2, first, last)) {
            const std::string parameter = std::to_string(j++).insert(0, 1, 'Z');
            const Plane<double> change = star.image(nominal_ipc);
            const StarShape<HyperDual> shape = exact_.along(change.view());
            add_all(parameter, shape);
            add("ee50_centroid", parameter, {half_light_.along(change.view(), shape, light), nan},
                nan);
        }
    }

    void add_all(const std::string &parameter, const StarShape<HyperDual> &shape) {
        for (const char *quantity : {"sigma", "e1", "e2"})
            add(quantity, parameter, {slope_of(shape, quantity).first, nan}, nan);
    }

  private:
    // A wrong pixel moves an image and its derivatives alike: a few times its share, as seen over
    // sweeps of EPS.
    double error(double slope) const {
        return 16 * (s_.psf.error_estimate() + s_.nominal.error_estimate) *
               std::max(1.0, std::abs(slope));
    }

    // Returns the slopes fitted to the q-th quantity, NaN if it was not measured.
    std::array<double, 2> add_law(const char *grid, const GridAxes &axes, size_t q,
                                  const std::vector<Place> &places) {
        if (std::isnan(quantities[q].of(places[0])))
            return {nan, nan};
        const std::vector<GridPoint> points = changes(places, axes.second, quantities[q]);
        const std::array<double, 2> fit = fit_linear(points);
        const size_t second = axes.second == &Ipc::alpha_prime ? 1 : 2;
        const std::array<double, 2> tangent{by_ipc_[q][0].first, by_ipc_[q][second].first};
        const double most = largest_change(points);
        laws_.add({s_.band.name, double(source_.sca), double(s_.struts), grid, quantities[q].name,
                   most, largest_error(points, fit) / most, largest_error(points, tangent) / most});
        return fit;
    }

    const StudySource &source_;
    const BandStar &s_;
    StudyTable &slopes_, &laws_;
    StarSlopes exact_;
    HalfLightSlopes half_light_;
    std::array<std::array<Slope, ipc_parameters>, std::size(quantities)> by_ipc_;
};

} // namespace

void add_sensitivities(const StudySource &source, const Stars &stars, Study &study) {
    StudyTable slopes{{"band", "sca", "struts", "quantity", "parameter", "paper", "value",
                       "fit_value", "error_estimate", "second_derivative"},
                      {}};
    StudyTable laws{{"band", "sca", "struts", "grid", "quantity", "largest_change", "fit_error",
                     "tangent_error"},
                    {}};
    for (const BandStar &s : stars) {
        StarReport report(source, s, slopes, laws);
        if (s.struts == source.struts) {
            report.add_zernikes();
            report.add_blur();
        }
    }
    study[WFPSF_STUDY_SENSITIVITIES] = std::move(slopes);
    study[WFPSF_STUDY_LINEAR_LAW] = std::move(laws);
}

void add_figures(const StudySource &source, const Stars &stars, Study &study) {
    using Change = double (*)(const Place &, const Place &);
    const Change sigma = [](const Place &p, const Place &from) {
        return 100 * (p.shape.sigma / from.shape.sigma - 1);
    };
    const Change half_light = [](const Place &p, const Place &from) {
        return 100 * (p.ee50 / from.ee50 - 1);
    };
    const Change e1 = [](const Place &p, const Place &from) { return p.shape.e1 - from.shape.e1; };
    const Change e2 = [](const Place &p, const Place &from) { return p.shape.e2 - from.shape.e2; };
    struct Figure {
        int32_t table;
        Change change;
        double unit = 1;
    };
    struct Panel {
        const GridAxes &axes;
        Ipc from; // of the changes, and of the axes
        const char *x, *y;
        bool with_half_light;
        std::vector<Figure> figures;
    };
    const Panel panels[] = {{figure_isotropic,
                             {},
                             "alpha",
                             "alpha_prime",
                             true,
                             {{WFPSF_STUDY_FIGURE_3, sigma},
                              {WFPSF_STUDY_FIGURE_4, half_light},
                              {WFPSF_STUDY_FIGURE_5, e1},
                              {WFPSF_STUDY_FIGURE_6, e2}}},
                            {figure_anisotropic,
                             {},
                             "alpha",
                             "alpha_plus",
                             false,
                             {{WFPSF_STUDY_FIGURE_7, e1}, {WFPSF_STUDY_FIGURE_8, e2}}},
                            {isotropic,
                             nominal_ipc,
                             "delta_alpha",
                             "delta_alpha_prime",
                             false,
                             {{WFPSF_STUDY_FIGURE_9, sigma},
                              {WFPSF_STUDY_FIGURE_10, e1, 1000},
                              {WFPSF_STUDY_FIGURE_11, e2, 1000}}}};

    for (const Panel &panel : panels) {
        for (const Figure &figure : panel.figures)
            study[figure.table].columns = {panel.x, panel.y};
        for (const BandStar &s : stars) {
            if (s.struts != source.struts || !is_shown(source.instrument, s.band))
                continue;
            const std::vector<Place> places = measured(s, panel.axes, panel.with_half_light);
            const Place from = measured(s, panel.from, panel.with_half_light);
            for (const Figure &figure : panel.figures) {
                StudyTable &table = study[figure.table];
                table.columns.emplace_back(s.band.name);
                table.rows.resize(places.size());
                for (size_t i = 0; i < places.size(); ++i) {
                    const Ipc &ipc = places[i].ipc;
                    if (table.rows[i].empty())
                        table.rows[i] = {ipc.alpha - panel.from.alpha,
                                         ipc.*panel.axes.second - panel.from.*panel.axes.second};
                    table.rows[i].emplace_back(figure.unit * figure.change(places[i], from));
                }
            }
        }
    }
}

} // namespace wfpsf
