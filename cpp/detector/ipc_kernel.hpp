// SPDX-License-Identifier: GPL-3.0-or-later
// IPC kernels. The tap K(dx, dy) is the share of a pixel's charge that is read dx pixels to the
// right of it and dy above: out(p) = sum over d of K(d) in(p - d), a convolution (Kannawadi et al.
// 2016, Eq. 4). A table meant for the correlation, sum over d of K(d) in(p + d), is turned into
// this form by flipped(). x is the fast axis, y points up.
#pragma once

#include "image/view.hpp"

#include <array>
#include <complex>
#include <utility>

namespace wfpsf {

// A kernel conserves charge: its taps sum to 1 within this.
inline constexpr double kernel_sum_tolerance = 1e-12;
inline constexpr int64_t max_kernel_size = 1023; // taps along an axis

struct KernelOptions {
    bool allow_negative = false; // else every tap must lie in 0..1
    bool normalise = false;      // divide by the sum, which must be positive
};

// Standard deviations of the taps measured for WFC3 (Eq. 11), as wfc3() has them: its order, its
// division.
std::array<double, 9> wfc3_uncertainties();

// Centroid of the taps and second moments about it. Both add to the unweighted moments of any
// image that the kernel is applied to.
struct KernelMoments {
    double x, y;
    double xx, xy, yy;
};

// How far a kernel is from symmetric: the largest difference between a tap and its image.
struct KernelAsymmetry {
    double left_right, up_down, half_turn;
    double transposed; // infinite if the kernel is not square
};

// min |K^| over all frequencies, where it is met. Dividing by K^ amplifies noise by 1 / value
// there.
struct StabilityMargin {
    double value;
    double frequency_x, frequency_y; // cycles per pixel, -1/2..1/2
};

class IpcKernel {
  public:
    // The 3 x 3 kernels of Eqs. 7 (alpha), 8 (and alpha') and 9 (and alpha+). alpha_plus
    // strengthens the coupling along x: K(+-1, 0) = alpha + alpha_plus, K(0, +-1) = alpha -
    // alpha_plus.
    static IpcKernel parametric(double alpha, double alpha_prime = 0, double alpha_plus = 0,
                                KernelOptions options = {});

    // Any table of odd sizes, laid out as an image: its middle is K(0, 0), its first row the
    // lowest.
    static IpcKernel from_table(View<const double> table, KernelOptions options = {});

    // The kernel measured for WFC3 (Eq. 11), divided by its sum, which is 0.9985 as printed.
    // Columns are read left to right and rows top to bottom as where the response is: K(-1, 0) is
    // 0.0163 and K(+1, 0) 0.0164 before the division.
    static IpcKernel wfc3();

    // 2 delta - K: undoes K to first order in the couplings (Eq. 12, for any kernel).
    IpcKernel first_order_correction() const;

    // The sum of the first order + 1 terms of Neumann's series, (delta - K)^k: it leaves an error
    // of order + 1 in the couplings. Order 0 is delta, order 1 the first-order correction.
    IpcKernel neumann_correction(int64_t order) const;

    // This kernel applied after another.
    IpcKernel composed(const IpcKernel &other) const;

    // A(l) = sum over d of K(d) K(d + l): white noise of variance 1 has this covariance at lag l
    // after the kernel. A(0) is the share of the variance that stays in a pixel.
    IpcKernel autocorrelation() const;

    // K(-d): as a convolution it does what K does as a correlation, and the other way round.
    IpcKernel flipped() const;

    int64_t nx() const { return taps_.nx(); }
    int64_t ny() const { return taps_.ny(); }
    int64_t reach_x() const { return nx() / 2; }
    int64_t reach_y() const { return ny() / 2; }
    // |dx| <= reach_x(), |dy| <= reach_y()
    double operator()(int64_t dx, int64_t dy) const {
        return taps_(dx + reach_x(), dy + reach_y());
    }

    double tap_or_zero(int64_t dx, int64_t dy) const { // any dx, dy
        const bool is_within =
            dx >= -reach_x() && dx <= reach_x() && dy >= -reach_y() && dy <= reach_y();
        return is_within ? (*this)(dx, dy) : 0;
    }

    View<const double> table() const { return taps_.view(); }

    double sum() const;
    double sum_of_squares() const;
    KernelMoments moments() const;
    KernelAsymmetry asymmetry() const;

    // K^(k) = sum over d of K(d) exp(-2 pi i k . d), k in cycles per pixel.
    std::complex<double> transform(double frequency_x, double frequency_y) const;

    // From a grid of frequencies finer than the kernel's bandwidth, polished between them.
    StabilityMargin margin() const;

  private:
    explicit IpcKernel(Plane<double> taps) : taps_(std::move(taps)) {}

    Plane<double> taps_;
};

} // namespace wfpsf
