// SPDX-License-Identifier: GPL-3.0-or-later
// IPC whose kernel varies from pixel to pixel: K_q(d) is that of pixel q.
#pragma once

#include "detector/chebyshev.hpp"
#include "detector/ipc_solve.hpp"
#include "image/image.hpp"

#include <array>
#include <span>
#include <variant>
#include <vector>

namespace wfpsf {

// Which pixel's kernel couples two. With the same kernels one is the transpose of the other.
enum class IpcForm : int32_t {
    scatter = 0, // out(p) = sum of K_(p-d)(d) in(p - d): each charge is spread by its own pixel's
                 // kernel, so charge is conserved
    gather = 1,  // out(p) = sum of K_p(d) in(p + d): each pixel collects by its own kernel
};

// Coefficients of X^i Y^j by growing i + j, then by growing j. X and Y run from -1 to 1 between the
// outer borders of a detector's outermost pixels.
class SurfacePolynomial {
  public:
    static constexpr int64_t most_degree = 20;
    static int64_t coefficients_of(int64_t degree) { return (degree + 1) * (degree + 2) / 2; }

    static void require_degree(int64_t degree);

    // Zero.
    SurfacePolynomial() : SurfacePolynomial(0, std::array{0.0}) {}
    SurfacePolynomial(int64_t degree, std::span<const double> coefficients);
    void row(int64_t nx, int64_t ny, int64_t y, double *values) const;

  private:
    size_t degree_;
    std::vector<double> coefficients_;
};

class VaryingIpc {
  public:
    // The 3 x 3 kernels of alpha, alpha_prime and alpha_plus (Eqs. 7-9), each a map or a
    // polynomial over nx x ny pixels. Every pixel's taps must lie in 0..1 unless negative ones are
    // allowed.
    using Surface = std::variant<SurfacePolynomial, Plane<float>, Plane<double>>;
    static VaryingIpc parametric(int64_t nx, int64_t ny, std::array<Surface, 3> parameters,
                                 bool allow_negative = false);

    // Pixel (x, y) has the kernel of index regions(x, y).
    static VaryingIpc of_regions(const Image &regions, std::span<const IpcKernel> kernels);

    int64_t nx() const { return nx_; }
    int64_t ny() const { return ny_; }
    int64_t reach_x() const { return reach_x_; }
    int64_t reach_y() const { return reach_y_; }

    void require_pixel(int64_t x, int64_t y) const; // or WFPSF_ERROR_RANGE
    IpcKernel kernel(int64_t x, int64_t y) const;

    // K_q(d) of the pixels q of row y, in the order of the list below: taps(x, k).
    struct Offset {
        int64_t dx, dy;
    };
    std::span<const Offset> offsets() const { return offsets_; } // those where any K_q is not 0
    void taps(int64_t y, View<double> taps) const;

    // The pixel whose own kernel has the least min |K^|.
    struct Weakest {
        double margin = 1;
        int64_t x = 0, y = 0;
    };
    const Weakest &weakest() const { return weakest_; }
    // Of the real parts of all K_q^.
    SpectralInterval spectrum() const { return spectrum_; }

  private:
    struct Regions {
        Plane<int32_t> index;
        std::vector<IpcKernel> kernels;
    };
    struct Parameters {
        std::array<Surface, 3> surfaces;
    };

    VaryingIpc(int64_t nx, int64_t ny) : nx_(nx), ny_(ny) {}
    void parameters(int64_t y, View<double> rows) const;
    void check_row(int64_t y, View<const double> rows, bool allow_negative);

    int64_t nx_, ny_, reach_x_ = 0, reach_y_ = 0;
    std::variant<Parameters, Regions> model_;
    std::vector<Offset> offsets_;
    Weakest weakest_;
    SpectralInterval spectrum_{1, 1};
};

struct VaryingConvolution {
    IpcForm form = IpcForm::scatter;
    Edge edge = Edge::zero; // beyond the border, replicate continues the kernels as it does pixels
    double fill = 0;
    int threads = 1; // the bits are the same for any number
};

// in has the size of the detector; tap_step 1. out may be in itself, else they share no memory.
void convolve(const VaryingIpc &ipc, View<const float> in, const VaryingConvolution &how,
              View<float> out);
void convolve(const VaryingIpc &ipc, View<const double> in, const VaryingConvolution &how,
              View<double> out);

// The image that gives the one observed, by Chebyshev's iteration, to a residual that is reported.
// Refused if the kernel of any pixel is below the least margin. Edges zero, replicate and wrap.
// The amplification of noise is measured, on noise, if it is wanted: it costs a rough solution.
Solution solve_ipc(const VaryingIpc &ipc, View<const float> in, const VaryingConvolution &how,
                   const SolveLimits &limits, bool with_noise, View<float> out);
Solution solve_ipc(const VaryingIpc &ipc, View<const double> in, const VaryingConvolution &how,
                   const SolveLimits &limits, bool with_noise, View<double> out);

} // namespace wfpsf
