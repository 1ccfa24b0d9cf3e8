// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/far_light.hpp"

#include "error/error.hpp"
#include "numerics/bands.hpp"
#include "optics/add_stars.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace wfpsf {

namespace {

constexpr double nearest_pixel = 24; // of the tables
constexpr size_t colours = 11;       // enough for the fringes that the tables hold

FarSource far_source(const Optics &optics, const Light &light, const PsfSettings &settings) {
    const double diameter = optics.aperture->diameter();
    const double path = diameter * nearest_pixel * settings.pixel_scale;
    const Spectrum spectrum = light(path);
    const auto [blue, red] = std::ranges::minmax(spectrum.wavelength);
    const double fringes = path * (1 / blue - 1 / red);
    if (!(fringes >= 2))
        fail(WFPSF_ERROR_ARGUMENT,
             "light: %g fringes differ across the pupil at %g pixels, must be 2 or more", fringes,
             nearest_pixel);
    const WavelengthRule rule(spectrum, colours);
    return {optics, settings,
            rule.exact() ? spectrum : Spectrum{rule.wavelengths(), rule.weights(spectrum)},
            nearest_pixel, light};
}

} // namespace

FarLight::FarLight(const Optics &optics, const Light &light, const PsfSettings &settings)
    : FarLight(far_source(optics, light, settings), pupil_edges(optics.aperture->parts())) {}

namespace {

// Edges of about one direction, which the tables hold with what goes on from their ends.
bool together(const std::vector<Fringes> &tables, size_t a, size_t b) {
    return a == b || std::ranges::any_of(tables, [&](const Fringes &table) {
               return std::ranges::count(table.members(), a) > 0 &&
                      std::ranges::count(table.members(), b) > 0;
           });
}

// By straight edge the curved ones whose fringes with it the tables hold.
using Arcs = std::vector<std::vector<size_t>>;
Arcs arcs_in(const std::vector<Fringes> &tables, const PupilEdges &edges) {
    Arcs arcs(edges.straight.size());
    for (const ArcOnwards &arc : arcs_onwards(edges, widest_kink))
        for (size_t edge = 0; edge < arcs.size(); ++edge)
            if (together(tables, edge, arc.straight))
                arcs[edge].push_back(arc.at.edge);
    return arcs;
}

// For fringes with edges: rims as they are, and what is left of them without those arcs.
std::vector<RimPoint> points_for_fringes(std::vector<RimPoint> points, const Arcs &arcs,
                                         const FarSource &source, const PupilEdges &edges) {
    for (size_t edge = 0; edge < arcs.size(); ++edge)
        if (!arcs[edge].empty())
            std::ranges::move(rim_points_without(arcs[edge], edge, source, edges),
                              std::back_inserter(points));
    return points;
}

PointFringes<RimPoint>::Known known_rims(const PupilEdges &edges, const Arcs &arcs) {
    return [&](size_t edge, const RimPoint &point) {
        if (point.edge)
            return *point.edge != edge;
        return std::ranges::any_of(
            arcs[edge], [&](size_t arc) { return edges.curved[arc].oval == point.oval; });
    };
}

PointFringes<Corner>::Known known_corners(const std::vector<Fringes> &tables) {
    return [&](size_t edge, const Corner &corner) {
        return std::ranges::any_of(corner.straight,
                                   [&](size_t other) { return together(tables, edge, other); });
    };
}

} // namespace

// What the members are made from.
struct FarLight::Parts {
    Parts(const FarSource &source, const PupilEdges &edges)
        : rims(rim_points(source, edges)), spikes(make_spikes(source, edges)),
          arcs(arcs_in(spikes.fringes, edges)),
          visibility(std::make_shared<Visibility>(source, 1.1 * source.optics.aperture->diameter() *
                                                              fringes_end * source.pixel())),
          narrow(source, edges, *visibility, 6), middle(source, edges, *visibility, 9),
          wide(source, edges, *visibility, 22, 1.8) {}
    RimPoints rims;
    Spikes spikes;
    Arcs arcs; // of the spikes' tables
    std::shared_ptr<const Visibility> visibility;
    EdgeColours narrow, middle, wide; // tables across
};

FarLight::FarLight(const FarSource &source, const PupilEdges &edges)
    : FarLight(source, edges, Parts(source, edges)) {}

FarLight::FarLight(const FarSource &source, const PupilEdges &edges, Parts parts)
    : nearest_(source.nearest), mirror_(source.settings.mirrored ? -1 : 1),
      spikes_(std::move(parts.spikes)), halo_(source, edges, parts.rims),
      edge_fringes_(source, edges, parts.wide, parts.visibility, spikes_.fringes),
      rim_fringes_(source, parts.middle, parts.visibility,
                   points_for_fringes(std::move(parts.rims.own), parts.arcs, source, edges),
                   known_rims(edges, parts.arcs), halo_),
      corner_fringes_(source, parts.narrow, parts.visibility, corners(source, edges),
                      known_corners(spikes_.fringes), halo_) {}

void FarLight::add(const PixelRow &row, double floor) const {
    halo_.add(row, floor);
    for (const Spike &spike : spikes_.spikes)
        spike.add(row, floor);
    for (const Fringes &fringes : spikes_.fringes)
        fringes.add(row, floor);
    edge_fringes_.add(row, floor);
    rim_fringes_.add(row, floor);
    corner_fringes_.add(row, floor);
}

double FarLight::at(double x, double y) const {
    double light[2]; // a row has two pixels or more
    uint8_t lit[1] = {0};
    constexpr double no_floor = 1e-30;
    add({x, mirror_ * y, light, lit}, no_floor);
    return lit[0] ? light[0] : 0;
}

template <class T>
void FarLight::add(const Star &star, double inner, double floor, View<T> image, int threads) const {
    if (!(inner >= nearest_))
        fail(WFPSF_ERROR_RANGE, "inner = %g: must be %g or more", inner, nearest_);
    if (!(floor > 0))
        fail(WFPSF_ERROR_RANGE, "floor = %g: must be above 0", floor);
    if (star.flux == 0)
        return;
    const double share = floor / std::abs(star.flux);
    on_bands_of_rows(image.ny, threads, [&](int64_t first_row, int64_t last_row) {
        std::vector<double> light(static_cast<size_t>(image.nx));
        std::vector<uint8_t> lit(light.size() / PixelRow::block + 1);
        for (int64_t y = first_row; y <= last_row; ++y) {
            const double off = static_cast<double>(y) - star.y;
            const auto part = [&](int64_t first, int64_t end) {
                first = std::clamp<int64_t>(first, 0, image.nx);
                end = std::clamp<int64_t>(end, first, image.nx);
                if (first == end)
                    return;
                std::ranges::fill(lit, uint8_t{0});
                const PixelRow row(static_cast<double>(first) - star.x, mirror_ * off,
                                   {light.data(), static_cast<size_t>(end - first)}, lit);
                add(row, share);
                row.for_lit([&](int64_t from, std::span<const double> pixels) {
                    T *const to = &image(first + from, y);
                    for (size_t i = 0; i < pixels.size(); ++i)
                        to[static_cast<int64_t>(i) * image.stride_x] +=
                            static_cast<T>(star.flux * pixels[i]);
                });
            };
            if (std::abs(off) > inner) {
                part(0, image.nx);
            } else {
                part(0, static_cast<int64_t>(std::ceil(star.x - inner)));
                part(static_cast<int64_t>(std::floor(star.x + inner)) + 1, image.nx);
            }
        }
    });
}

double FarLight::brightest_beyond(double r) const {
    // On a spike's line others give their tails; those in about its direction all they have.
    double most = 0;
    for (const Spike &on : spikes_.spikes) {
        double sum = 0;
        for (const Spike &spike : spikes_.spikes)
            sum += spike.brightest_off(r, on.axes());
        for (const Fringes &fringes : spikes_.fringes)
            if (std::abs(fringes.axes().across(on.axes().nx, on.axes().ny)) < same_direction)
                sum += fringes.brightest(r);
        sum += edge_fringes_.brightest(r, on.axes()) + rim_fringes_.brightest(r, on.axes()) +
               corner_fringes_.brightest(r, on.axes());
        most = std::max(most, sum);
    }
    return halo_.brightest(r) + most;
}

FarLight::Error FarLight::relative_error(double r) const {
    constexpr double between_rims = 0.16, on_spikes = 0.3;
    return {on_spikes * halo_.brightest(r) / brightest_beyond(r), between_rims};
}

std::vector<FarLight::Direction> FarLight::spikes(double r, double floor) const {
    std::vector<Direction> out;
    for (const Spike &spike : spikes_.spikes)
        out.push_back({spike.axes().nx, mirror_ * spike.axes().ny, spike.half_width(r, floor)});
    return out;
}

template void FarLight::add(const Star &, double, double, View<float>, int) const;
template void FarLight::add(const Star &, double, double, View<double>, int) const;

} // namespace wfpsf
