// SPDX-License-Identifier: GPL-3.0-or-later
// The light of a bright star far from the core, from about 30 native pixels on: diffraction spikes
// and halo, from the pupil's edges alone (Keller's geometrical theory of diffraction, 1962, J. Opt.
// Soc. Am. 52, 116). Some nanoseconds a pixel; the exact engine's cost grows with the distance.
#pragma once

#include "image/archive.hpp"
#include "image/view.hpp"
#include "optics/far_edge_fringes.hpp"
#include "optics/far_halo.hpp"
#include "optics/far_point_fringes.hpp"
#include "optics/far_spikes.hpp"

#include <vector>

namespace wfpsf {

// Immutable once made; all members may be called from many threads. Light is a fraction of all
// light in a native pixel, as in Psf; without pixel response it is the density at the pixel's
// centre.
class FarLight {
  public:
    // Of pupils given as geometry, and light of so many colours that fringes across the pupil are
    // washed out: WFPSF_ERROR_ARGUMENT for masks and narrow bands.
    FarLight(const Optics &optics, const Light &light, const PsfSettings &settings);

    // Where it begins, native pixels from the star.
    double nearest() const { return nearest_; }

    // At (x, y) native pixels from the star, nearest() off or farther.
    double at(double x, double y) const;

    // Adds a star's far light to all pixels that are more than `inner` native pixels off it along
    // either axis, nearest() or more: all that a stamp of that radius leaves out. Spikes and halo
    // are drawn where they may be above `floor`, in units of the image.
    template <class T>
    void add(const Star &star, double inner, double floor, View<T> image, int threads = 1) const;

    // No pixel as far from the star as r, or farther, gets more.
    double brightest_beyond(double r) const;
    double halo_beyond(double r) const { return halo_.brightest(r); } // between the spikes

    // The spikes point along (x, y) and (-x, -y), in the image's frame.
    struct Direction {
        double x, y;
        double half_width; // from where on, across, the spike is below the floor
    };
    std::vector<Direction> spikes(double r, double floor) const;

    // The radius from which on all halo between the spikes is below the floor.
    double halo_radius(double floor) const { return halo_.radius(floor); }

    // The largest error of pixels at r or farther: near the spikes' lines as a share of
    // brightest_beyond(r), elsewhere of halo_beyond(r). Fitted to the worst of all pixels from 40 on
    // off Roman's pupil and WFIRST's, in bands of 2.5 to 18 fringes at the nearest; half that from 90
    // on, and the rms is an eighth (tests/unit/optics/far_light_test.cpp).
    struct Error {
        double spikes, halo;
    };
    Error relative_error(double r) const;

    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.nearest_, self.mirror_, self.spikes_, self.halo_, self.edge_fringes_,
                self.rim_fringes_, self.corner_fringes_);
    }

  private:
    friend class ArchiveReader;
    FarLight() = default; // what an archive holds goes in
    struct Parts;
    FarLight(const FarSource &source, const PupilEdges &edges);
    FarLight(const FarSource &source, const PupilEdges &edges, Parts parts);
    void add(const PixelRow &row, double floor) const;

    double nearest_ = 0, mirror_ = 1;
    Spikes spikes_;
    Halo halo_;
    EdgeFringes edge_fringes_;
    PointFringes<RimPoint> rim_fringes_;
    PointFringes<Corner> corner_fringes_;
};

} // namespace wfpsf
