// SPDX-License-Identifier: GPL-3.0-or-later
// A star's image as IPC changes it: linear in alpha, alpha' and alpha+, so that four images make
// all others, and the derivatives by the three are images themselves.
#pragma once

#include "image/view.hpp"
#include "moments/adaptive.hpp"
#include "moments/hyper_dual.hpp"
#include "moments/sensitivity.hpp"
#include "optics/blur.hpp"
#include "optics/psf.hpp"

#include <array>
#include <optional>
#include <vector>

namespace wfpsf {

struct Ipc {
    double alpha = 0, alpha_prime = 0, alpha_plus = 0;
};
inline constexpr Ipc nominal_ipc{0.02, 0.002, 0}; // of an H4RG
inline constexpr size_t ipc_parameters = 3;

// What the study follows. Native pixels; `trace` is tr M.
template <class N> struct StarShape { N x, y, sigma, trace, e1, e2; };

class IpcStar {
  public:
    // On samples N a native pixel, the star at the centre of a square.
    IpcStar(const Psf &psf, int64_t oversampling, int64_t native_side);
    // The same from that image, or from how it changes: IPC is linear in it.
    IpcStar(Plane<double> image, int64_t oversampling);

    // As many samples as moments of a band-limited image need: its spectrum times the weight's is
    // rounding at the first alias. Light of no more than so many cycles a native pixel.
    static int64_t sufficient_oversampling(double bandwidth);
    // As many native pixels as the weight reaches.
    static int64_t sufficient_side(double bandwidth);

    Plane<double> image(const Ipc &ipc) const;
    View<const double> change(size_t parameter) const { return changes_[parameter].view(); }

    // Near `guess`, if the caller knows a solution; samples.
    AdaptiveMoments measure(const Plane<double> &image,
                            const std::optional<Gaussian> &guess = {}) const;
    StarShape<double> shape(const AdaptiveMoments &m) const;

    int64_t oversampling() const { return oversampling_; }
    int64_t side() const { return image_.nx(); }
    double centre() const { return static_cast<double>(side() - 1) / 2; }

  private:
    int64_t oversampling_;
    Plane<double> image_;
    std::array<Plane<double>, ipc_parameters> changes_;
};

// The paper's field, native pixels: what its light is, all of it, is the total of EE50.
inline constexpr int64_t field_side = 32;

// How a star's image without IPC answers to a parameter, and the light on the field.
struct StarChange {
    IpcStar star;
    double light;
};

// To Noll's Zernike terms first_j, first_j + 1, ..., per wave at the wavelength of the PSF's
// settings; unit rms over a circle of that radius.
std::vector<StarChange> zernike_changes(const Psf &psf, const IpcStar &star, double radius_m,
                                        size_t first_j, size_t last_j);

inline constexpr AdaptiveOptions study_moments{.tolerance = 1e-12};

// Derivatives at a solution, along any change of the image.
class StarSlopes {
  public:
    StarSlopes(const IpcStar &star, const Plane<double> &image, const AdaptiveMoments &solution);

    // da is the first derivative along the change, dab the second, if the image is linear in it.
    StarShape<HyperDual> along(View<const double> change) const;
    // By a variance of additional Gaussian blur, native pixels^2: along it the image obeys the heat
    // equation, and the sums under the weight take the derivatives over. No second derivative.
    StarShape<HyperDual> along_blur(const Covariance &variance) const;

  private:
    StarShape<HyperDual> shape(const ImageChange &change) const;

    double oversampling_;
    Gaussian weight_;
    WeightedSums sums_;
    Sensitivity sensitivity_;
};

} // namespace wfpsf
