// SPDX-License-Identifier: GPL-3.0-or-later
// The stars that a study measures: a detector's, through a band, with or without struts.
#pragma once

#include "moments/encircled.hpp"
#include "study/ipc_star.hpp"
#include "study/study.hpp"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace wfpsf {

// Makes PSFs, and remembers the last aperture.
class StarMaker {
  public:
    explicit StarMaker(const StudySource &source) : source_(source) {}

    // Paper's rule for the effective wavelength.
    static double wavelength(const Band &band);
    double bandwidth(const Band &band) const; // cycles a native pixel
    Optics optics(int sca, const Band &band, bool struts);
    Psf psf(int sca, const Band &band, bool struts, double radius);

    const StudySource &source() const { return source_; }

  private:
    const StudySource &source_;
    std::shared_ptr<const Aperture> aperture_;
    const Pupil *of_pupil_ = nullptr; // that aperture_ was made of; none for the annulus
};

// One of the study's own detector, with its solutions before and after the nominal IPC.
struct BandStar {
    const Band &band;
    bool struts;
    double bandwidth, eps;
    Psf psf;
    IpcStar star;
    std::array<double, 2> light; // on the field: all of it, for EE50; by the variance of blur
    Plane<double> image;         // with the nominal IPC
    AdaptiveMoments bare, nominal;

    BandStar(StarMaker &maker, const Band &of_band, bool with_struts);

    // EE50 of an image, native pixels, about a point of it. Its error is the integral's.
    Estimated half_light(const Plane<double> &of, double x, double y) const;
    Estimated half_light_axis(const Plane<double> &of) const {
        return half_light(of, star.centre(), star.centre());
    }
    EncircledOptions encircled() const; // meets a hundredth of eps, or 1e-8, of a radius
    EncircledOptions encircled(double eps) const;
    // Relative error of sizes, and half of that of ellipticities, numerical.
    double error(const AdaptiveMoments &m) const;
};

// Derivatives of EE50, (1/EE50) dEE50, with the nominal IPC.
class HalfLightSlopes {
  public:
    explicit HalfLightSlopes(const BandStar &star);
    // About the centroid: the image changes, perhaps its light on the field, and the centroid
    // moves, given how it answers to the change.
    double along(View<const double> change, const StarShape<HyperDual> &shape,
                 double light = 0) const;
    // By the variance of blur that is the same along x and y, native pixels^2: the light that it
    // drives over the circle.
    double along_blur(const StarShape<HyperDual> &shape) const;

  private:
    double moved(double gained, const StarShape<HyperDual> &shape) const;

    const BandStar &s_;
    EncircledOptions precise_;
    Estimated radius_; // samples
    DiscLight disc_;
    double by_x_, by_y_; // of it by the centre, samples
};

// About the optical axis, which stays: with the second derivative along a change.
class AxisHalfLight {
  public:
    explicit AxisHalfLight(const BandStar &star);
    struct Slope {
        double first, second;
    };
    Slope along(View<const double> change) const;

  private:
    const BandStar &s_;
    EncircledOptions precise_;
    Estimated radius_; // samples
    DiscLight disc_;
};

// A solution, or an Error that names the band.
AdaptiveMoments solved(const IpcStar &star, const Plane<double> &image, const Band &band,
                       const std::optional<Gaussian> &guess = {});

} // namespace wfpsf
