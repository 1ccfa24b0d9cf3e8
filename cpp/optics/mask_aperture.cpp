// SPDX-License-Identifier: GPL-3.0-or-later
// A pupil given as an image: the Fourier transform of its square pixels, each with the phase of its
// centre, or of points in their place.
#include "error/error.hpp"
#include "numerics/chirp.hpp"
#include "numerics/dispatch.hpp"
#include "numerics/phasor.hpp"
#include "optics/aperture.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-13; // of |A|^2 in units of area^2: sums of 10^4 to 10^7 terms
using Complex = std::complex<double>;

// weight exp(2 pi i turns), `stride` numbers apart.
WFPSF_VECTORISED void waves(const double *weight, const double *turns, int64_t count, Complex *out,
                            int64_t stride) {
    for (int64_t n = 0; n < count; ++n) {
        double cosine, sine;
        phasor(turns[n], cosine, sine);
        out[n * stride] = {weight[n] * cosine, weight[n] * sine};
    }
}

// The transform along x of all of the mask's lines, to be transformed along y as rows are asked
// for.
class MaskStrips final : public DiffractionStrips {
  public:
    // lines(x of the grid, line of the mask); squared[i]: of the transform of a pixel's side at
    // grid index i.
    MaskStrips(Plane<Complex> lines, std::vector<double> squared, double turns, int64_t pixels)
        : lines_(std::move(lines)), squared_(std::move(squared)),
          along_y_(lines_.ny(), lines_.nx(), turns) {
        nodes_ = pixels;
        error_ = rounding;
    }

    // Every call transforms all lines anew.
    Plane<double> rows(int64_t first, int64_t count) const override {
        constexpr int64_t batch = ChirpTransform::batch;
        std::vector<Complex> buffer = along_y_.buffer();
        const auto at = [&buffer](int64_t element) {
            return &buffer[static_cast<size_t>(element * batch)];
        };
        Plane<double> intensity(lines_.nx(), count);
        for (int64_t begin = 0; begin < lines_.nx(); begin += batch) {
            const int64_t columns = std::min(batch, lines_.nx() - begin);
            for (int64_t y = 0; y < lines_.ny(); ++y)
                std::copy_n(lines_.view().row(y) + begin, columns, at(y));
            along_y_.run(buffer);
            for (int64_t y = 0; y < count; ++y)
                for (int64_t s = 0; s < columns; ++s)
                    intensity(begin + s, y) = squared_[static_cast<size_t>(begin + s)] *
                                              squared_[static_cast<size_t>(first + y)] *
                                              std::norm(at(along_y_.place(first + y))[s]);
        }
        return intensity;
    }

  private:
    Plane<Complex> lines_;
    std::vector<double> squared_;
    ChirpTransform along_y_;
};

class MaskAperture final : public Aperture {
  public:
    MaskAperture(View<const double> mask, double scale, double axis_x, double axis_y,
                 MaskPixels pixels)
        : pixels_(pixels), scale_(scale) {
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
        // One phase a square: the wavefront's slope is lost inside it, to second order.
        const double turn =
            pixels_ == MaskPixels::points ? 0 : 2 * pi * wavefront.slope_bound() * scale_;
        return {diffract_in_strips(wavefront, wavelength, grid, eps)->rows(0, grid.size),
                lit_.nx() * lit_.ny(), rounding, turn * turn / 12};
    }

    std::unique_ptr<const DiffractionStrips> diffract_in_strips(const Wavefront &wavefront,
                                                                double wavelength,
                                                                const FocalGrid &grid,
                                                                double) const override {
        const double turns = scale_ * grid.step / wavelength;
        std::vector<double> squared;
        for (int64_t i = 0; i < grid.size; ++i)
            squared.push_back(std::pow(side(2 * pi / wavelength * grid.angle(i)), 2));
        return std::make_unique<MaskStrips>(along_x(wavefront, grid.size, turns),
                                            std::move(squared), turns, lit_.nx() * lit_.ny());
    }

    std::vector<Plane<double>> changes(const Wavefront &, std::span<const Wavefront>, double,
                                       const FocalGrid &, double) const override {
        fail(WFPSF_ERROR_ARGUMENT, "mask: derivatives are of pupils given as geometry alone");
    }

    const std::vector<LitPart> &parts() const override {
        fail(WFPSF_ERROR_ARGUMENT, "mask: has pixels, and no edges that light far off comes from");
    }

    StripMemory strip_memory(double, const FocalGrid &grid, double) const override {
        const int64_t lines = grid.size * lit_.ny();
        const int64_t buffer = ChirpTransform::batch * 4 * (grid.size + lit_.ny());
        return {static_cast<int64_t>(sizeof(Complex)) * (lines + buffer),
                grid.size * static_cast<int64_t>(sizeof(double))};
    }

    WavefrontPairs pairs(const Wavefront &wavefront) const override {
        // Of large masks, some pixels tell as much.
        const int64_t stride = 1 + std::max(lit_.nx(), lit_.ny()) / 256;
        std::vector<double> waves, lit;
        for (int64_t y = 0; y < lit_.ny(); y += stride)
            for (int64_t x = 0; x < lit_.nx(); x += stride)
                if (lit_(x, y) > 0) {
                    waves.push_back(
                        wavefront(u_[static_cast<size_t>(x)], v_[static_cast<size_t>(y)]));
                    lit.push_back(lit_(x, y));
                }
        return {waves, lit};
    }

    PupilRaster raster(int64_t, int64_t) const override {
        if (pixels_ == MaskPixels::points)
            fail(WFPSF_ERROR_ARGUMENT, "mask: its pixels are points, which cover no area");
        return {.lit = lit_,
                .scale = scale_,
                .axis_x = -u_.front() / scale_,
                .axis_y = -v_.front() / scale_};
    }

  private:
    static constexpr int64_t batch = ChirpTransform::batch;
    static Complex *at(std::vector<Complex> &buffer, int64_t element) {
        return &buffer[static_cast<size_t>(element * batch)];
    }

    // Every row of the mask, aberrated and transformed, but for phases that are the same for all.
    Plane<Complex> along_x(const Wavefront &wavefront, int64_t size, double turns) const {
        const ChirpTransform transform(lit_.nx(), size, turns);
        std::vector<Complex> buffer = transform.buffer();
        std::vector<double> y(u_.size()), phases(u_.size());
        Plane<Complex> rows(size, lit_.ny());
        for (int64_t first = 0; first < lit_.ny(); first += batch) {
            const int64_t count = std::min(batch, lit_.ny() - first);
            for (int64_t s = 0; s < count; ++s) {
                std::ranges::fill(y, v_[static_cast<size_t>(first + s)]);
                wavefront.evaluate(u_, y, phases.data());
                waves(lit_.view().row(first + s), phases.data(), lit_.nx(), at(buffer, 0) + s,
                      batch);
            }
            transform.run(buffer);
            for (int64_t s = 0; s < count; ++s)
                for (int64_t x = 0; x < size; ++x)
                    rows(x, first + s) = at(buffer, transform.place(x))[s];
        }
        return rows;
    }

    // The transform of one pixel along an axis.
    double side(double k) const {
        const double half = k * scale_ / 2;
        return half == 0 || pixels_ == MaskPixels::points ? scale_ : scale_ * std::sin(half) / half;
    }

    MaskPixels pixels_;
    Plane<double> lit_;
    std::vector<double> u_, v_; // pixel centres, m
    double scale_;
};

} // namespace

std::unique_ptr<const Aperture> make_aperture(View<const double> mask, double scale, double axis_x,
                                              double axis_y, MaskPixels pixels) {
    return std::make_unique<MaskAperture>(mask, scale, axis_x, axis_y, pixels);
}

} // namespace wfpsf
