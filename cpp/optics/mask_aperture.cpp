// SPDX-License-Identifier: GPL-3.0-or-later
// A pupil given as an image: the matrix Fourier transform of its square pixels, each with the phase
// of its centre.
#include "error/error.hpp"
#include "optics/aperture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Dense>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-13; // of |A|^2 in units of area^2: sums of 10^4 to 10^7 terms
using Complex = std::complex<double>;
using Matrix = Eigen::MatrixXcd;

// exp(i k u angle_j) for j = first.. of the grid (rows) at every coordinate u (columns), by
// repeated multiplication, started afresh every 32 steps.
Matrix waves(const FocalGrid &grid, int64_t first, int64_t rows, const double *u, int64_t count,
             double k) {
    Matrix out(rows, count);
    for (int64_t n = 0; n < count; ++n) {
        const Complex turn = std::polar(1.0, k * u[n] * grid.step);
        Complex wave;
        for (int64_t j = 0; j < rows; ++j) {
            wave = j % 32 == 0 ? std::polar(1.0, k * u[n] * grid.angle(first + j)) : wave * turn;
            out(j, n) = wave;
        }
    }
    return out;
}

// The transform along x of all of the mask's lines, to be transformed along y as rows are asked
// for.
class MaskStrips final : public DiffractionStrips {
  public:
    // u, v: the mask's pixel centres, m.
    MaskStrips(const Plane<double> &lit, const std::vector<double> &u, const std::vector<double> &v,
               double scale, const Wavefront &wavefront, double wavelength, const FocalGrid &grid)
        : v_(v), scale_(scale), k_(2 * pi / wavelength), grid_(grid), lines_(grid.size, lit.ny()) {
        nodes_ = lit.nx() * lit.ny();
        error_ = rounding;
        constexpr int64_t block = 128;
        const Matrix along_x = waves(grid, 0, grid.size, u.data(), lit.nx(), k_);
        for (int64_t first = 0; first < lit.ny(); first += block) {
            const int64_t count = std::min(block, lit.ny() - first);
            Matrix field(lit.nx(), count);
            for (int64_t y = 0; y < count; ++y)
                for (int64_t x = 0; x < lit.nx(); ++x) {
                    const double transmission = lit(x, first + y);
                    field(x, y) =
                        transmission == 0
                            ? Complex(0)
                            : std::polar(transmission,
                                         2 * pi *
                                             wavefront(u[static_cast<size_t>(x)],
                                                       v[static_cast<size_t>(first + y)]));
                }
            lines_.middleCols(first, count).noalias() = along_x * field;
        }
    }

    Plane<double> rows(int64_t first, int64_t count) const override {
        const Matrix along_y =
            waves(grid_, first, count, v_.data(), static_cast<int64_t>(v_.size()), k_);
        const Matrix amplitude = lines_ * along_y.transpose();
        Plane<double> intensity(grid_.size, count);
        for (int64_t y = 0; y < count; ++y)
            for (int64_t x = 0; x < grid_.size; ++x)
                intensity(x, y) = std::norm(amplitude(x, y) * square(k_ * grid_.angle(x)) *
                                            square(k_ * grid_.angle(first + y)));
        return intensity;
    }

  private:
    // The transform of one pixel's side.
    double square(double k) const {
        const double half = k * scale_ / 2;
        return half == 0 ? scale_ : scale_ * std::sin(half) / half;
    }

    std::vector<double> v_;
    double scale_, k_;
    FocalGrid grid_;
    Matrix lines_; // (x of the grid, line of the mask)
};

class MaskAperture final : public Aperture {
  public:
    MaskAperture(View<const double> mask, double scale, double axis_x, double axis_y)
        : scale_(scale) {
        int64_t x0 = mask.nx, x1 = -1, y0 = mask.ny, y1 = -1;
        for (int64_t y = 0; y < mask.ny; ++y)
            for (int64_t x = 0; x < mask.nx; ++x) {
                const double lit = mask(x, y);
                if (!std::isfinite(lit))
                    fail(WFPSF_ERROR_NOT_FINITE, "mask pixel (%lld, %lld) = %g: must be finite",
                         static_cast<long long>(x), static_cast<long long>(y), lit);
                if (!(lit >= 0 && lit <= 1))
                    fail(WFPSF_ERROR_RANGE,
                         "mask pixel (%lld, %lld) = %g: a transmission must be 0..1",
                         static_cast<long long>(x), static_cast<long long>(y), lit);
                if (lit == 0)
                    continue;
                x0 = std::min(x0, x), x1 = std::max(x1, x);
                y0 = std::min(y0, y), y1 = std::max(y1, y);
            }
        if (x1 < 0)
            fail(WFPSF_ERROR_ARGUMENT, "mask: no pixel is lit");
        lit_ = Plane<double>(x1 - x0 + 1, y1 - y0 + 1);
        for (int64_t y = y0; y <= y1; ++y)
            for (int64_t x = x0; x <= x1; ++x) {
                lit_(x - x0, y - y0) = mask(x, y);
                area_ += mask(x, y) * scale * scale;
            }
        for (int64_t x = x0; x <= x1; ++x)
            u_.push_back((static_cast<double>(x) - axis_x) * scale);
        for (int64_t y = y0; y <= y1; ++y)
            v_.push_back((static_cast<double>(y) - axis_y) * scale);
        diameter_ = static_cast<double>(std::max(lit_.nx(), lit_.ny())) * scale;
    }

    Diffraction diffract(const Wavefront &wavefront, double wavelength, const FocalGrid &grid,
                         double eps) const override {
        // One phase a pixel: the wavefront's slope is lost inside it, to second order.
        const double turn = 2 * pi * wavefront.slope_bound() * scale_;
        return {diffract_in_strips(wavefront, wavelength, grid, eps)->rows(0, grid.size),
                lit_.nx() * lit_.ny(), rounding, turn * turn / 12};
    }

    std::unique_ptr<const DiffractionStrips> diffract_in_strips(const Wavefront &wavefront,
                                                                double wavelength,
                                                                const FocalGrid &grid,
                                                                double) const override {
        return std::make_unique<MaskStrips>(lit_, u_, v_, scale_, wavefront, wavelength, grid);
    }

    StripMemory strip_memory(double, const FocalGrid &grid, double) const override {
        const auto size = static_cast<int64_t>(sizeof(Complex));
        return {size * grid.size * (lit_.nx() + lit_.ny()), 2 * size * (grid.size + lit_.ny())};
    }

    PupilRaster raster(int64_t, int64_t) const override {
        return {.lit = lit_,
                .scale = scale_,
                .axis_x = -u_.front() / scale_,
                .axis_y = -v_.front() / scale_};
    }

  private:
    Plane<double> lit_;
    std::vector<double> u_, v_; // pixel centres, m
    double scale_;
};

} // namespace

std::unique_ptr<const Aperture> make_aperture(View<const double> mask, double scale, double axis_x,
                                              double axis_y) {
    return std::make_unique<MaskAperture>(mask, scale, axis_x, axis_y);
}

} // namespace wfpsf
