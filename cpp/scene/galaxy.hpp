// SPDX-License-Identifier: GPL-3.0-or-later
// Images of galaxies with elliptical Sersic profiles, seen through an effective PSF.
#pragma once

#include "image/view.hpp"
#include "numerics/bandlimited.hpp"
#include "optics/field.hpp"
#include "optics/otf.hpp"
#include "scene/catalogue.hpp"
#include "scene/galaxy_grid.hpp"
#include "scene/sersic.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace wfpsf {

struct Galaxy {
    double x, y; // centre, native pixels; the first pixel's centre is at (0, 0)
    double flux;
    double sersic_index;
    double half_light_radius; // arcsec; sqrt(a b) of the half-light ellipse
    // (a - b) / (a + b) exp(2 i phi), phi from the x axis to the major one: the reduced shear.
    double e1, e2;

    static constexpr double largest_radius = 1e5, largest_ellipticity = 0.98;
};

// With a star's place and flux.
inline Galaxy galaxy_at(const Star &centre, const GalaxyShape &shape) {
    return {centre.x, centre.y, centre.flux, shape.sersic_index, shape.half_light_radius_arcsec,
            shape.e1, shape.e2};
}

// `pixel_scale` in radians; the OTF must outlive what is made of it.
Transfer transfer_of(const Otf &otf, double pixel_scale);

// Draws any number of galaxies behind one PSF, on one thread: keeps the transfer function on the
// grids that were needed so far. The image is the sum over all wave numbers
//     flux * F(|S k| r_e) * OTF(k) exp(2 pi i k . (p - x)),  S the shear,
// at the pixels p; with ever coarser grids around the galaxy for the light farther out.
class GalaxyDrawer {
  public:
    // `pixel_scale` in arcsec; `profiles` may serve many drawers of a thread.
    GalaxyDrawer(Transfer transfer, double pixel_scale, SersicProfiles &profiles);

    struct Drawn {
        double light; // that the image got, of the galaxy's flux
        double error; // estimate of the largest error of any pixel, the transfer function's apart
    };

    // Adds a galaxy to an image of native pixels, clipped at the borders. No pixel is off by more
    // than `tolerance`, in units of the flux, unless the estimate says so: where the wings of the
    // PSF are brighter than that a thousand pixels out. Light fainter than that is left out far
    // from the galaxy. WFPSF_ERROR_RANGE, _NOT_FINITE for a galaxy that is none.
    template <class T> Drawn add(const Galaxy &galaxy, double tolerance, View<T> image);

    // Pixels farther than that from the galaxy, along either axis, get less than `tolerance`.
    double radius(const Galaxy &galaxy, double tolerance);

    // Is no pixel off by more than `tolerance` if a star is drawn in place of the galaxy?
    bool is_point_like(const Galaxy &galaxy, double tolerance);

  private:
    struct Shape; // a galaxy in pixels
    struct Level;
    struct Samples {
        View<double> values;
        double on_frame; // the largest
    };
    Shape shape_of(const Galaxy &galaxy);
    void measure_psf();
    double reach(const Shape &shape, double tolerance);
    const GalaxyGrid &grid(const Level &level, int64_t size);
    double bound(const Shape &shape, const Level &level) const;
    double highest_wave(const Shape &shape, double tolerance) const;
    Samples sample(const Shape &shape, const Level &level, const WaveForm &form, double tolerance);
    template <class T> double add_pixels(const Shape &shape, View<double> values, View<T> image);
    template <class T>
    double add_between(const Shape &shape, int64_t step, View<double> values, View<T> image);

    Transfer transfer_;
    double pixel_scale_;
    SersicProfiles &profiles_;
    BandlimitedInterpolator interpolator_;               // of coarse grids
    std::map<std::array<int64_t, 3>, GalaxyGrid> grids_; // by level, top or not, and size
    GalaxyBuffers buffers_;
    Plane<double> strip_;
    // The largest value of the PSF at a distance along x or y or farther, blurred by Gaussians of
    // half-light radii 0, 1, 2, 4 ... pixels.
    std::vector<std::vector<double>> wings_;
    double curvature_ = 0;
};

} // namespace wfpsf
