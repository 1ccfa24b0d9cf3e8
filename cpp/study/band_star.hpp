// SPDX-License-Identifier: GPL-3.0-or-later
// The stars that a study measures: a detector's, through a band, with or without struts.
#pragma once

#include "moments/encircled.hpp"
#include "study/ipc_star.hpp"
#include "study/study.hpp"

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
    double bandwidth;
    Psf psf;
    IpcStar star;
    double light;        // on 32 x 32 native pixels: all of it, for EE50
    Plane<double> image; // with the nominal IPC
    AdaptiveMoments bare, nominal;

    BandStar(StarMaker &maker, const Band &of_band, bool with_struts);

    // EE50 of an image, native pixels, about a point of it.
    double half_light(const Plane<double> &of, double x, double y) const;
    double half_light_axis(const Plane<double> &of) const {
        return half_light(of, star.centre(), star.centre());
    }
    EncircledOptions encircled(double eps = 1e-6) const; // meets 1e-8 of a radius
    // Relative error of sizes, and half of that of ellipticities, numerical.
    double error(const AdaptiveMoments &m) const;
};

// Derivatives of EE50 about the centroid, with the nominal IPC: the image changes, and the centroid
// moves.
class HalfLightSlopes {
  public:
    explicit HalfLightSlopes(const BandStar &star);
    // (1/EE50) dEE50, given how the centroid answers to the change.
    double along(View<const double> change, const StarShape<HyperDual> &shape) const;

  private:
    const BandStar &s_;
    EncircledOptions precise_;
    Estimated radius_; // samples
    DiscLight disc_;
    double by_x_, by_y_; // of it by the centre, samples
};

// A solution, or an Error that names the band.
AdaptiveMoments solved(const IpcStar &star, const Plane<double> &image, const Band &band,
                       const std::optional<Gaussian> &guess = {});

} // namespace wfpsf
