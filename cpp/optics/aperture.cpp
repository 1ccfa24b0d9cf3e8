// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/aperture.hpp"

#include "error/error.hpp"
#include "numerics/nufft.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-13; // of |A|^2 in units of area^2: sums of 10^3 to 10^7 terms
using Complex = std::complex<double>;
using Matrix = Eigen::MatrixXcd;

// exp(i k u angle_j) on the grid (rows) at every coordinate u (columns), by repeated
// multiplication, started afresh every 32 steps.
Matrix waves(const FocalGrid &grid, const double *u, int64_t count, double k) {
    Matrix out(grid.size, count);
    for (int64_t n = 0; n < count; ++n) {
        const Complex turn = std::polar(1.0, k * u[n] * grid.step);
        Complex wave;
        for (int64_t j = 0; j < grid.size; ++j) {
            wave = j % 32 == 0 ? std::polar(1.0, k * u[n] * grid.angle(j)) : wave * turn;
            out(j, n) = wave;
        }
    }
    return out;
}

// What the nodes send towards the focal plane: weight exp(2 pi i W).
std::vector<Complex> sources(const PupilNodes &nodes, const Wavefront &wavefront) {
    std::vector<Complex> field(nodes.size());
    for (size_t n = 0; n < nodes.size(); ++n)
        field[n] = std::polar(nodes.weight[n], 2 * pi * wavefront(nodes.x[n], nodes.y[n]));
    return field;
}

// The amplitude on the whole grid, by a nonuniform FFT.
Plane<Complex> transform(const PupilNodes &nodes, const Wavefront &wavefront, double wavelength,
                         const FocalGrid &grid, double eps) {
    const double turn = 2 * pi / wavelength * grid.step;
    std::vector<double> a(nodes.size()), b(nodes.size());
    for (size_t n = 0; n < nodes.size(); ++n) {
        a[n] = turn * nodes.x[n];
        b[n] = turn * nodes.y[n];
    }
    Plane<Complex> out(grid.size, grid.size);
    nufft_type1(a, b, sources(nodes, wavefront), (grid.size - 1) / 2, eps, out.view().data);
    return out;
}

// Grid indices on each axis at which an amplitude is checked, all pairs of them: errors grow
// outwards, so mostly near the border.
std::array<int64_t, 4> probes(const FocalGrid &grid) {
    const double half = grid.half();
    return {0, std::llround(0.4 * half), std::llround(1.8 * half), grid.size - 1};
}

// The amplitude at the probes by plain summation: probe y * 4 + x.
std::array<Complex, 16> sum_at_probes(const PupilNodes &nodes, const Wavefront &wavefront,
                                      double wavelength, const FocalGrid &grid) {
    const double k = 2 * pi / wavelength;
    const std::array<int64_t, 4> at = probes(grid);
    const std::vector<Complex> field = sources(nodes, wavefront);
    std::array<Complex, 16> sums{};
    for (size_t n = 0; n < nodes.size(); ++n) {
        std::array<Complex, 4> along_x, along_y;
        for (size_t j = 0; j < 4; ++j) {
            along_x[j] = std::polar(1.0, k * nodes.x[n] * grid.angle(at[j]));
            along_y[j] = field[n] * std::polar(1.0, k * nodes.y[n] * grid.angle(at[j]));
        }
        for (size_t j = 0; j < 16; ++j)
            sums[j] += along_x[j % 4] * along_y[j / 4];
    }
    return sums;
}

Plane<Complex> to_plane(const Matrix &matrix) {
    Plane<Complex> plane(matrix.rows(), matrix.cols());
    Eigen::Map<Matrix>(plane.view().data, matrix.rows(), matrix.cols()) = matrix;
    return plane;
}

// A pupil given as geometry.
template <class Pupil> class GeometricAperture final : public Aperture {
  public:
    GeometricAperture(const Pupil &pupil, double diameter, double fit_error)
        : pupil_(pupil), fit_error_(fit_error) {
        const PupilNodes nodes = pupil_nodes(pupil, 1, 1e-15);
        for (const double weight : nodes.weight)
            area_ += weight;
        diameter_ = diameter;
    }

    Amplitude amplitude(const Wavefront &wavefront, double wavelength, const FocalGrid &grid,
                        double eps) const override {
        // The fastest wave over the pupil: the grid's corner, plus the wavefront's own slope.
        const double wavenumber =
            2 * pi *
            (std::numbers::sqrt2 * grid.largest_angle() / wavelength + wavefront.slope_bound());
        // Far from the core a wrong amplitude meets a small one, so that the intensity is better
        // than the amplitude: start loosely and let the check decide.
        for (double asked = std::min(0.1, 30 * eps);;) {
            const PupilNodes nodes = pupil_nodes(pupil_, wavenumber, asked);
            Plane<Complex> value = transform(nodes, wavefront, wavelength, grid, eps / 8);
            const double error = check(value, pupil_nodes(pupil_, wavenumber, asked * 1e-3),
                                       wavefront, wavelength, grid);
            if (error <= eps || asked < 1e-17)
                return {std::move(value), static_cast<int64_t>(nodes.size()), error, fit_error_};
            asked *= std::clamp(eps / error, 1e-3, 0.3);
        }
    }

  private:
    // Four times the largest difference of |A|^2 from a finer quadrature that is summed plainly.
    double check(const Plane<Complex> &value, const PupilNodes &finer, const Wavefront &wavefront,
                 double wavelength, const FocalGrid &grid) const {
        const std::array<int64_t, 4> at = probes(grid);
        const std::array<Complex, 16> truth = sum_at_probes(finer, wavefront, wavelength, grid);
        double worst = 0;
        for (size_t j = 0; j < 16; ++j)
            worst = std::max(
                worst, std::abs(std::norm(value(at[j % 4], at[j / 4])) - std::norm(truth[j])));
        return 4 * worst / (area_ * area_) + rounding;
    }

    Pupil pupil_;
    double fit_error_;
};

// A pupil given as an image: every pixel is a square with the phase of its centre.
class MaskAperture final : public Aperture {
  public:
    MaskAperture(View<const double> mask, double scale, double axis_x, double axis_y)
        : scale_(scale) {
        int64_t x0 = mask.nx, x1 = -1, y0 = mask.ny, y1 = -1;
        for (int64_t y = 0; y < mask.ny; ++y)
            for (int64_t x = 0; x < mask.nx; ++x) {
                const double lit = mask(x, y);
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

    Amplitude amplitude(const Wavefront &wavefront, double wavelength, const FocalGrid &grid,
                        double) const override {
        constexpr int64_t rows = 128;
        const double k = 2 * pi / wavelength;
        const Matrix along_x = waves(grid, u_.data(), lit_.nx(), k);
        Matrix sum = Matrix::Zero(grid.size, grid.size);
        for (int64_t first = 0; first < lit_.ny(); first += rows) {
            const int64_t count = std::min(rows, lit_.ny() - first);
            Matrix field(lit_.nx(), count);
            for (int64_t y = 0; y < count; ++y)
                for (int64_t x = 0; x < lit_.nx(); ++x) {
                    const double lit = lit_(x, first + y);
                    field(x, y) =
                        lit == 0
                            ? Complex(0)
                            : std::polar(lit, 2 * pi *
                                                  wavefront(u_[static_cast<size_t>(x)],
                                                            v_[static_cast<size_t>(first + y)]));
                }
            const Matrix along_y = waves(grid, v_.data() + first, count, k);
            const Matrix transformed = along_x * field;
            sum.noalias() += transformed * along_y.transpose();
        }
        for (int64_t y = 0; y < grid.size; ++y)
            for (int64_t x = 0; x < grid.size; ++x)
                sum(x, y) *= square(k * grid.angle(x)) * square(k * grid.angle(y));
        // One phase a pixel: the wavefront's slope is lost inside it, to second order.
        const double turn = 2 * pi * wavefront.slope_bound() * scale_;
        return {to_plane(sum), lit_.nx() * lit_.ny(), rounding, turn * turn / 12};
    }

  private:
    // The transform of one pixel's side.
    double square(double k) const {
        const double half = k * scale_ / 2;
        return half == 0 ? scale_ : scale_ * std::sin(half) / half;
    }

    Plane<double> lit_;
    std::vector<double> u_, v_; // pixel centres, m
    double scale_;
};

} // namespace

std::unique_ptr<const Aperture> make_aperture(const SegmentedPupil &pupil) {
    return std::make_unique<GeometricAperture<SegmentedPupil>>(pupil, 2 * pupil.outer.radius,
                                                               pupil.fit_error);
}

std::unique_ptr<const Aperture> make_aperture(const AnnularPupil &pupil) {
    return std::make_unique<GeometricAperture<AnnularPupil>>(pupil, 2 * pupil.outer_radius, 0.0);
}

std::unique_ptr<const Aperture> make_aperture(View<const double> mask, double scale, double axis_x,
                                              double axis_y) {
    return std::make_unique<MaskAperture>(mask, scale, axis_x, axis_y);
}

} // namespace wfpsf
