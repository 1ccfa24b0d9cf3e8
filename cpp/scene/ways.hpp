// SPDX-License-Identifier: GPL-3.0-or-later
// The ways to draw a group of sources, each with what it costs and how far it may be off.
#pragma once

#include "scene/far_reach.hpp"
#include "scene/groups.hpp"
#include "scene/light_profile.hpp"

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace wfpsf {

struct SceneBudget {
    double noise = 0.01;   // largest error of a pixel, in units of its noise
    double variance = 100; // of a pixel's noise beside the sources' own, e-^2
    // Largest share of a source's light that its stamp may leave out.
    double flux = std::numeric_limits<double>::infinity();

    double error() const; // e- that a pixel without sources may be off
};

enum class Drawing {
    shared,      // as stars, each with the PSF of its place from a model of the whole detector
    own,         // as stars, with PSFs made for each
    fourier,     // as galaxies, by Fourier transform, with the PSF of a part of the detector
    fourier_own, // the same with PSFs made for each
};

// Where far light comes from.
enum class FarDrawing {
    tables, // those that all share, as far as they reach
    nearest, // beyond them, from the pupil's edges at the nearest of the places that they are made of
    own,     // from the edges at the star's own place, but for what tables know better
};

struct Way {
    Drawing drawing = Drawing::shared;
    double radius = 0;   // of the stamp, native pixels
    double eps = 0;      // of the PSF, of its peak; of galaxies, of a pixel as a share of the flux
    double left_out = 0; // by the shared model: largest share of the light in a pixel
    double far = 0;      // light beyond the stamp is drawn down to that share; 0: none is
    FarDrawing far_drawing = FarDrawing::tables;

    // What is left out is drawn all the same, as smooth light.
    bool is_smooth_beyond() const { return drawing == Drawing::shared; }

    // Own PSFs are made out to here; what is farther is drawn straight from the diffraction image.
    static constexpr double largest_field = 512;
};

// A PSF of the whole detector that groups of one colour share.
struct SharedModel {
    bool needed = false;
    double eps = 0, radius = 0; // native pixels
    double time_s = 0;
    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.needed, self.eps, self.radius, self.time_s);
    }
};

// Tables of far light that groups of one colour share.
struct SharedFarLight {
    bool needed = false;
    // Within, it is that of an exact PSF of the detector's middle, and only how other places differ
    // comes from the pupil's edges; native pixels, 0: all does.
    double exact_radius = 0;
    double exact_eps = 0;
    double radius = 0; // where the tables end, native pixels
    // What those that are there already will do for: light down to that share, and differences
    // between places out to a radius and down to a share.
    double floor = 0;
    double differences_radius = std::numeric_limits<double>::infinity(), differences_floor = 0;
    double time_s = 0;
    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.needed, self.exact_radius, self.exact_eps, self.radius, self.floor,
                self.differences_radius, self.differences_floor, self.time_s);
    }
};

// A colour's PSFs, as far as plans need to know them.
struct ColourFacts {
    LightProfile profile;
    double bandwidth = 0;             // relative; 0: one wavelength
    bool varies = false;              // over the detector
    bool is_complete = false;         // as known as for the brightest stars
    std::vector<FarLight> far_lights; // at FarTables::places(), if plans may use them
    std::optional<FarReach> far;
    double far_varies = 0; // largest difference between those places, as a share of the brightest

    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.profile, self.bandwidth, self.varies, self.is_complete, self.far_lights,
                self.far, self.far_varies);
    }
};

// What exact far light is made to, so that stars of `densest` e- in a pixel are off by a small part of
// the budget.
double exact_far_eps(double densest, const ColourFacts &colour, const SceneBudget &budget);

// From where on it is of no account to stars of that flux how far light differs from place to place.
double same_beyond(const ColourFacts &colour, double flux, const SceneBudget &budget);

// Errors of a pixel, e-; where a star's own light adds noise, as many as are that share of the
// noise in a pixel without sources. Those in single places hardly ever meet: their squares add up.
// The means of what is left out everywhere add up themselves.
struct PixelError {
    double local = 0, mean = 0;
};

struct Offer {
    Way way;
    double time_s = std::numeric_limits<double>::infinity(); // of the group
    PixelError error = {std::numeric_limits<double>::infinity(), 0};
};
using Take = std::function<void(const Offer &)>;

// What a group's stars are off, e- as in PixelError, by a way's PSFs.
double psf_error(const SourceGroup &group, const ColourFacts &colour, const SceneBudget &budget,
                 const Way &way);

class Ways {
  public:
    Ways(const SourceGroup &group, const ColourFacts &colour, const SceneBudget &budget,
         const SceneImage &image);

    // As stars, with the detector's PSFs made to `eps`, on stamps of radii above `from` up to `to`,
    // or with PSFs of their own; with far light beyond the stamps, if there are tables of it, else
    // without.
    void of_shared(double eps, double from, double to, const SharedFarLight &far,
                   const Take &take) const;
    void of_own(const SharedFarLight &far, const Take &take) const;
    // Of galaxies; `place_error`: of a pixel, if the PSF is that of a part of the detector.
    void of_fourier(double place_error, const Take &take) const;

  private:
    double count() const { return static_cast<double>(group_.count); }
    double pixels(double radius) const;
    double width(double radius) const;
    double shared_stamps(double radius, double left_out) const; // seconds
    double cut(double radius) const;
    double mean(double light, double cut) const;
    double flux_within(double radius) const;
    double scatter_beyond(double radius) const;
    double meeting(double in_stamp, double beyond) const;
    PixelError left_out(const Way &way, double local, double from, double cut) const;
    double far_off(const SharedFarLight &far, const Way &way) const;
    // What is beyond the stamps: far light, if there are tables of it.
    void go_beyond(const Way &way, double time_s, const SharedFarLight &far,
                   const Take &take) const;
    void add_far(const Way &way, double time_s, const SharedFarLight &far, const Take &take) const;
    void leave_far(const Way &way, double time_s, const Take &take) const;

    const SourceGroup &group_;
    const ColourFacts &colour_;
    const SceneBudget &budget_;
    const SceneImage &image_;
    std::vector<double> scatter_; // beyond the rings of ways.cpp
};

} // namespace wfpsf
