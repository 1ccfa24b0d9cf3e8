// SPDX-License-Identifier: GPL-3.0-or-later
#include "observation/observation.hpp"

#include "error/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace wfpsf {

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double margin_pix = 8192; // how far beyond its pixels a detector's WCS reaches

void check_angle(const char *argument, double value, double largest) {
    if (!std::isfinite(value))
        fail(WFPSF_ERROR_NOT_FINITE, "%s = %g: must be finite", argument, value);
    if (!(std::abs(value) <= largest))
        fail(WFPSF_ERROR_RANGE, "%s = %.17g: must be %g..%g", argument, value, -largest, largest);
}

struct HigherOrders {
    SipTerms a, b;
};

double binomial(int n, int k) {
    double value = 1;
    for (int i = 1; i <= k; ++i)
        value = value * (n - k + i) / i;
    return value;
}

// The field's distortion about a detector's middle, as terms that a detector's linear ones are
// applied to: Taylor's series of the polynomial. Pixel axes run along or against the field's.
HigherOrders orders_of_field(const DetectorWcs &detector, std::span<const DistortionTerm> field) {
    constexpr double unit_mm = 100, per_pixel = WcsTables::pixel_mm / unit_mm;
    const auto &[east_x, east_y, north_x, north_y] = detector.linear;
    const double along_x = std::copysign(per_pixel, east_x);
    const double along_y = std::copysign(per_pixel, north_y);
    const double determinant = east_x * north_y - east_y * north_x;
    HigherOrders orders{};
    for (size_t i = 0; i < sip_powers.size(); ++i) {
        const auto [p, q] = sip_powers[i];
        double east = 0, north = 0;
        for (const DistortionTerm &term : field) {
            if (term.p < p || term.q < q)
                continue;
            const double slope = binomial(term.p, p) * binomial(term.q, q) *
                                 std::pow(detector.east_mm / unit_mm, term.p - p) *
                                 std::pow(detector.north_mm / unit_mm, term.q - q);
            east += term.east * slope;
            north += term.north * slope;
        }
        const double pixels = std::pow(along_x, p) * std::pow(along_y, q) / determinant;
        orders.a[i] = (north_y * east - east_y * north) * pixels;
        orders.b[i] = (east_x * north - north_x * east) * pixels;
    }
    return orders;
}

} // namespace

Observation::Observation(const Instrument &instrument, const SkyPosition &pointing, double pa_deg,
                         const ObservationOptions &options)
    : options_(options) {
    if (!instrument.wcs)
        fail(WFPSF_ERROR_NO_WCS, "instrument = %s: its detectors have no places on the sky",
             instrument.name);
    constexpr double furthest = 1e6;
    check_angle("ra_deg", pointing.ra_deg, furthest);
    check_angle("dec_deg", pointing.dec_deg, 90);
    check_angle("pa_deg", pa_deg, furthest);

    const WcsTables &tables = *instrument.wcs;
    cuts_to_integers_ = tables.cuts_to_integers;
    pointing_ = {full_turn(pointing.ra_deg), pointing.dec_deg};
    observatory_angle_ =
        half_turn(options.angle_is_of_fpa ? pa_deg - tables.fpa_angle_deg : pa_deg);
    fpa_angle_ = half_turn(options.angle_is_of_fpa ? pa_deg : pa_deg + tables.fpa_angle_deg);
    const double cosine = std::cos(fpa_angle_ * degree), sine = std::sin(fpa_angle_ * degree);
    const SkyFrame frame(pointing_);
    const auto last_x = static_cast<double>(instrument.pixels.x - 1);
    const auto last_y = static_cast<double>(instrument.pixels.y - 1);
    for (const DetectorWcs &detector : tables.detectors) {
        const double west = detector.u_deg * cosine - detector.v_deg * sine;
        const double north = detector.u_deg * sine + detector.v_deg * cosine;
        const SkyPosition reference = position_of(frame.tangent(-west, north));
        // North of the pointing, a degree up the tangent plane.
        const double angle = half_turn(
            fpa_angle_ + SkyFrame(reference).position_angle_deg(frame.tangent(-west, north + 1)));
        const double c = std::cos(angle * degree), s = std::sin(angle * degree);
        const auto &[east_x, east_y, north_x, north_y] = detector.linear;
        const std::array cd = {c * east_x + s * north_x, c * east_y + s * north_y,
                               -s * east_x + c * north_x, -s * east_y + c * north_y};
        const HigherOrders orders = options.as_galsim
                                        ? HigherOrders{detector.a, detector.b}
                                        : orders_of_field(detector, tables.distortion);
        const TanSip wcs(reference, cd, orders.a, orders.b,
                         {-margin_pix, last_x + margin_pix, -margin_pix, last_y + margin_pix});

        const PixelBounds &all = detector.with_gaps;
        const std::array<double, 4> corner_x = {
            static_cast<double>(all.x_first - 1), static_cast<double>(all.x_last + 1),
            static_cast<double>(all.x_first - 1), static_cast<double>(all.x_last + 1)};
        const std::array<double, 4> corner_y = {
            static_cast<double>(all.y_first - 1), static_cast<double>(all.y_first - 1),
            static_cast<double>(all.y_last + 1), static_cast<double>(all.y_last + 1)};
        const Vector middle = wcs.frame().centre;
        double radius = 0;
        for (size_t i = 0; i < corner_x.size(); ++i) {
            SkyPosition corner{};
            wcs.to_sky(1, &corner_x[i], &corner_y[i], &corner.ra_deg, &corner.dec_deg);
            radius = std::max(radius, angle_deg(middle, direction(corner)));
        }
        detectors_.push_back({wcs,
                              angle,
                              {0, instrument.pixels.x - 1, 0, instrument.pixels.y - 1},
                              all,
                              middle,
                              std::cos(1.01 * radius * degree)});
    }
}

// Each pass turns the pointing as the target is seen from where the pixel is.
Observation Observation::aimed(const Instrument &instrument, int sca, double x, double y,
                               const SkyPosition &target, double pa_deg,
                               const ObservationOptions &options) {
    constexpr int most_passes = 100;
    const Vector wanted = direction(target);
    SkyPosition pointing = target;
    for (int pass = 0; pass < most_passes; ++pass) {
        Observation observation(instrument, pointing, pa_deg, options);
        SkyPosition seen{};
        if (observation.wcs(sca).to_sky(1, &x, &y, &seen.ra_deg, &seen.dec_deg) != 0)
            fail(WFPSF_ERROR_RANGE, "x = %g, y = %g: must be on the detector or within %g pixels",
                 x, y, margin_pix);
        const Vector from = direction(seen);
        constexpr double close_deg = 1e-12;
        if (angle_deg(from, wanted) < close_deg)
            return observation;
        // The turn that takes `from` to `wanted` (Rodrigues).
        const Vector axis = cross(from, wanted), at = direction(pointing);
        const Vector turned = cross(axis, at);
        const double cosine = dot(from, wanted), along = dot(axis, at) / (1 + cosine);
        Vector next{};
        for (size_t i = 0; i < 3; ++i)
            next[i] = cosine * at[i] + turned[i] + along * axis[i];
        pointing = position_of(next);
    }
    fail(WFPSF_ERROR_RANGE,
         "dec_deg = %.17g: no pointing at pa_deg = %g was found that has the pixel there; must be "
         "farther from the pole",
         target.dec_deg, pa_deg);
}

void Observation::check_sca(int sca) const {
    if (sca < 1 || sca > sca_count())
        fail(WFPSF_ERROR_RANGE, "sca = %d: must be 1..%d", sca, sca_count());
}

const TanSip &Observation::wcs(int sca) const {
    check_sca(sca);
    return detectors_[static_cast<size_t>(sca - 1)].wcs;
}

double Observation::detector_angle_deg(int sca) const {
    check_sca(sca);
    return detectors_[static_cast<size_t>(sca - 1)].angle_deg;
}

PixelBounds Observation::bounds(int sca, bool with_gaps) const {
    check_sca(sca);
    const Detector &detector = detectors_[static_cast<size_t>(sca - 1)];
    return with_gaps ? detector.with_gaps : detector.active;
}

// A pixel is a square about its centre. In GalSim, the outer halves of the edge pixels do not
// count; or, counted from 1, positions are cut to integers first.
bool Observation::holds(const PixelBounds &bounds, double x, double y) const {
    const auto within = [&](double value, int64_t first, int64_t last) {
        if (!options_.as_galsim)
            return value >= static_cast<double>(first) - 0.5 &&
                   value < static_cast<double>(last) + 0.5;
        const double place = cuts_to_integers_ ? std::trunc(value + 1) - 1 : value;
        return place >= static_cast<double>(first) && place <= static_cast<double>(last);
    };
    return within(x, bounds.x_first, bounds.x_last) && within(y, bounds.y_first, bounds.y_last);
}

int64_t Observation::find(bool with_gaps, int64_t count, const double *ra_deg,
                          const double *dec_deg, int32_t *sca, double *x, double *y) const {
    int64_t found = 0;
    for (int64_t i = 0; i < count; ++i) {
        const SkyPosition position{ra_deg[i], dec_deg[i]};
        const Vector towards = direction(position);
        int32_t on = 0;
        double at_x = nan, at_y = nan;
        for (size_t k = 0; k < detectors_.size() && on == 0; ++k) {
            const Detector &detector = detectors_[k];
            if (!(dot(towards, detector.middle) >= detector.least_cosine))
                continue;
            double near_x = nan, near_y = nan;
            detector.wcs.to_pixel(1, &position.ra_deg, &position.dec_deg, &near_x, &near_y);
            if (!holds(with_gaps ? detector.with_gaps : detector.active, near_x, near_y))
                continue;
            on = static_cast<int32_t>(k + 1);
            at_x = near_x;
            at_y = near_y;
            ++found;
        }
        sca[i] = on;
        if (x)
            x[i] = at_x;
        if (y)
            y[i] = at_y;
    }
    return found;
}

} // namespace wfpsf
