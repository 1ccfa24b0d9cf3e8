// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/band_star.hpp"

#include "error/error.hpp"
#include "moments/unweighted.hpp"

#include <algorithm>
#include <utility>

namespace wfpsf {

namespace {

// The light of a star that samples on the field hold, and its derivative by a variance of blur:
// half of the Laplacian's sum, which is the outward difference of the outermost samples.
std::array<double, 2> light_on_field(const Psf &psf, int64_t oversampling) {
    const int64_t side = field_side * oversampling, last = side - 1;
    Plane<double> field(side, side);
    const double centre = static_cast<double>(last) / 2;
    psf.draw({centre, centre, 1}, oversampling, field.view());
    double gained = 0;
    for (int64_t i = 0; i < side; ++i)
        gained += field(i, 0) - field(i, 1) + field(i, last) - field(i, last - 1) + field(0, i) -
                  field(1, i) + field(last, i) - field(last - 1, i);
    return {pixel_sum(std::as_const(field).view()),
            gained / 2 * static_cast<double>(oversampling * oversampling)};
}

} // namespace

double StarMaker::wavelength(const Band &band) {
    return thinned_wavelengths(band).effective_nm * 1e-9;
}

double StarMaker::bandwidth(const Band &band) const {
    return source_.instrument.diameter_m() * source_.settings.pixel_scale / wavelength(band);
}

Optics StarMaker::optics(int sca, const Band &band, bool struts) {
    const Pupil *pupil = struts ? &source_.instrument.pupil(sca, band.name) : nullptr;
    if (!aperture_ || pupil != of_pupil_) {
        aperture_ = pupil ? std::visit([](const auto &p) { return make_aperture(p); }, *pupil)
                          : make_aperture(source_.instrument.annular_pupil());
        of_pupil_ = pupil;
    }
    return {aperture_, source_.wavefront(sca), source_.settings.wavelength};
}

Psf StarMaker::psf(int sca, const Band &band, bool struts, double radius) {
    PsfSettings settings = source_.settings;
    settings.radius = radius;
    const Light light = monochromatic(wavelength(band));
    return std::move(make_psfs(optics(sca, band, struts), {&light, 1}, settings,
                               {.memory_limit = source_.manners.memory_limit})[0]);
}

AdaptiveMoments solved(const IpcStar &star, const Plane<double> &image, const Band &band,
                       const std::optional<Gaussian> &guess) {
    AdaptiveMoments m = star.measure(image, guess);
    if (m.status < 0 || m.status == WFPSF_WARNING_NOT_CONVERGED)
        fail(m.status < 0 ? m.status : WFPSF_ERROR_MOMENTS_STALLED,
             "moments of the PSF in band %s: %s", band.name, m.line.c_str());
    return m;
}

BandStar::BandStar(StarMaker &maker, const Band &of_band, bool with_struts)
    : band(of_band), struts(with_struts), bandwidth(maker.bandwidth(of_band)),
      eps(maker.source().settings.eps),
      psf(maker.psf(maker.source().sca, of_band, with_struts, field_side / 2.0)),
      star(psf, IpcStar::sufficient_oversampling(bandwidth),
           std::max<int64_t>(16, IpcStar::sufficient_side(bandwidth))),
      light(light_on_field(psf, star.oversampling())), image(star.image(nominal_ipc)),
      bare(solved(star, star.image({}), band)), nominal(solved(star, image, band, bare.weight)) {}

EncircledOptions BandStar::encircled() const {
    return encircled(std::clamp(eps, 1e-10, 1e-6));
}
EncircledOptions BandStar::encircled(double asked) const {
    return {bandwidth / static_cast<double>(star.oversampling()), asked};
}

Estimated BandStar::half_light(const Plane<double> &of, double x, double y) const {
    const Estimated radius = encircled_radius(of.view(), x, y, 0.5, light[0], encircled());
    const auto oversampling = static_cast<double>(star.oversampling());
    return {radius.value / oversampling, radius.error_estimate / oversampling};
}

double BandStar::error(const AdaptiveMoments &m) const {
    return m.error_estimate / 2 + 2 * psf.error_estimate();
}

// By the image exactly; by the centre, which matters less, from central differences without their
// second order.
HalfLightSlopes::HalfLightSlopes(const BandStar &star)
    : s_(star), precise_(star.encircled(1e-10)),
      radius_(encircled_radius(star.image.view(), star.nominal.weight.x, star.nominal.weight.y, 0.5,
                               star.light[0], precise_)),
      disc_(disc_light(star.image.view(), star.nominal.weight.x, star.nominal.weight.y,
                       radius_.value, precise_)) {
    const auto oversampling = static_cast<double>(star.star.oversampling());
    const Gaussian &w = star.nominal.weight;
    const auto slope = [&](double x, double y) {
        const auto difference = [&](double h) {
            return (star.half_light(star.image, w.x + h * x, w.y + h * y).value -
                    star.half_light(star.image, w.x - h * x, w.y - h * y).value) *
                   oversampling / (2 * h);
        };
        const double h = 0.02 * oversampling;
        return (4 * difference(h) - difference(2 * h)) / 3;
    };
    by_x_ = slope(1, 0);
    by_y_ = slope(0, 1);
}

double HalfLightSlopes::along(View<const double> change, const StarShape<HyperDual> &shape,
                              double light) const {
    const Gaussian &w = s_.nominal.weight;
    const HeldChange a{disc_light(change, w.x, w.y, radius_.value, precise_), 0.5 * light};
    return moved(radius_slope(radius_, disc_, a).value, shape);
}

// The image obeys the heat equation: the disc gains half of the integral of dI/dr along the circle,
// E'' - E'/R.
double HalfLightSlopes::along_blur(const StarShape<HyperDual> &shape) const {
    const auto oversampling = static_cast<double>(s_.star.oversampling());
    HeldChange a;
    a.held = 0.5 * s_.light[1];
    a.disc.energy = oversampling * oversampling * (disc_.slope - disc_.density / radius_.value) / 2;
    return moved(radius_slope(radius_, disc_, a).value, shape);
}

double HalfLightSlopes::moved(double gained, const StarShape<HyperDual> &shape) const {
    const auto oversampling = static_cast<double>(s_.star.oversampling());
    return (gained + oversampling * (by_x_ * shape.x.da + by_y_ * shape.y.da)) / radius_.value;
}

AxisHalfLight::AxisHalfLight(const BandStar &star)
    : s_(star), precise_(star.encircled(1e-10)),
      radius_(encircled_radius(star.image.view(), star.star.centre(), star.star.centre(), 0.5,
                               star.light[0], precise_)),
      disc_(disc_light(star.image.view(), star.star.centre(), star.star.centre(), radius_.value,
                       precise_)) {}

AxisHalfLight::Slope AxisHalfLight::along(View<const double> change) const {
    const double centre = s_.star.centre();
    const HeldChange a{disc_light(change, centre, centre, radius_.value, precise_)};
    return {radius_slope(radius_, disc_, a).value / radius_.value,
            radius_curvature(radius_, disc_, a, a, precise_).value / radius_.value};
}

} // namespace wfpsf
