// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/otf.hpp"

#include "numerics/fft.hpp"
#include "numerics/sinc.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-13;
constexpr int64_t first_pixels = 128;
constexpr int64_t margin = 2; // of zeros around a lattice, and of conjugates below it
using Complex = std::complex<double>;

// The mean of exp(2 pi i W) over a pixel's lit part: by four Gauss points where all of it is lit,
// by the centroid at its edges. A mask's pixel has the phase of its centre.
Complex mean_phase(const Wavefront &wavefront, const PupilRaster &raster, int64_t x, int64_t y) {
    const double u = static_cast<double>(x) - raster.axis_x;
    const double v = static_cast<double>(y) - raster.axis_y;
    const auto phase = [&](double dx, double dy) {
        return std::polar(1.0,
                          2 * pi * wavefront((u + dx) * raster.scale, (v + dy) * raster.scale));
    };
    if (raster.is_pupil())
        return phase(0, 0);
    if (raster.lit(x, y) < 1 - 1e-6)
        return phase(raster.centroid_x(x, y), raster.centroid_y(x, y));
    constexpr double d = std::numbers::inv_sqrt3 / 2;
    return (phase(-d, -d) + phase(d, -d) + phase(-d, d) + phase(d, d)) / 4.0;
}

} // namespace

Otf::Otf(std::span<const Component> components, double pixel_scale, bool mirrored, double eps,
         const Covariance &blur, bool pixel_response)
    : mirrored_(mirrored), pixel_response_(pixel_response), pixel_scale_(pixel_scale), blur_(blur) {
    // All lattices together take as much memory as the largest one alone.
    const auto most =
        2 * static_cast<int64_t>(static_cast<double>(most_pixels) /
                                 (2 * std::sqrt(static_cast<double>(components.size()))));
    for (int64_t n = first_pixels;;) {
        make(components, n);
        estimate(components, n);
        if (error_ <= eps || n >= most)
            break;
        // The error falls as the square of the pixel.
        const double factor = std::clamp(std::sqrt(1.2 * error_ / eps), 1.1, 16.0);
        n = std::min(most,
                     2 * static_cast<int64_t>(std::ceil(static_cast<double>(n) * factor / 2)));
    }
}

void Otf::make(std::span<const Component> components, int64_t n) {
    lattices_.clear();
    cutoff_ = value_error_ = 0;
    pixels_ = 0;
    double total = 0;
    for (const Component &component : components) {
        lattices_.push_back(autocorrelation(component, n));
        const Lattice &lattice = lattices_.back();
        cutoff_ = std::max(cutoff_, static_cast<double>(lattice.width) / lattice.pixels_per_k);
        pixels_ = std::max(pixels_, lattice.width);
        value_error_ = std::max(value_error_, lattice.blur);
        exact_ = exact_ && lattice.exact;
        total += lattice.weight;
    }
    for (Lattice &lattice : lattices_)
        lattice.weight /= total;
}

Otf::Lattice Otf::autocorrelation(const Component &component, int64_t n) {
    const PupilRaster raster = component.aperture->raster(n, n);
    const int64_t nx = raster.lit.nx(), ny = raster.lit.ny();
    const int64_t width = std::max(nx, ny);
    const int64_t size = good_fft_length(2 * (width + margin) + 1);
    Plane<Complex> field(size, size);
    double lit = 0, squares = 0;
    for (int64_t y = 0; y < ny; ++y)
        for (int64_t x = 0; x < nx; ++x)
            if (const double c = raster.lit(x, y); c > 0) {
                field(x, y) = c * mean_phase(component.wavefront, raster, x, y);
                lit += c;
                squares += c * c;
            }
    const BackwardFft2d fft(size, size);
    fft.run(field.view().data);
    for (int64_t y = 0; y < size; ++y)
        for (int64_t x = 0; x < size; ++x)
            field(x, y) = std::norm(field(x, y));
    fft.run(field.view().data); // sum over l of f(l) conj f(l + m), times size^2

    const auto samples = static_cast<double>(size) * static_cast<double>(size);
    const double scale = 1 / (samples * (raster.is_pupil() ? squares : lit));
    const auto sum = [&](int64_t x, int64_t y) {
        return scale * field(x > 0 ? size - x : -x, y > 0 ? size - y : -y);
    };
    // Averaging over pixels widens both factors: of a smooth autocorrelation f they leave
    // f + h^2/12 (its second derivatives), which is taken off again.
    const double sharpening = raster.is_pupil() ? 0 : 1.0 / 12;
    Lattice lattice{Plane<Complex>(2 * (width + margin) + 1, width + 2 * margin + 1),
                    width,
                    component.wavelength / raster.scale,
                    component.weight,
                    raster.is_pupil() ? rounding : 1 - squares / lit,
                    raster.is_pupil()};
    for (int64_t y = -margin; y < width; ++y)
        for (int64_t x = 1 - width; x < width; ++x) {
            const Complex middle = sum(x, y);
            lattice.value(x + width + margin, y + margin) =
                middle - sharpening * (sum(x - 1, y) + sum(x + 1, y) + sum(x, y - 1) +
                                       sum(x, y + 1) - 4.0 * middle);
        }
    lattice.value(width + margin, margin) = 1;
    return lattice;
}

// Bilinear between a mask's pixels, where that is exact; else by cubic polynomials along both axes.
Complex Otf::Lattice::at(double x, double y) const {
    if (y < 0)
        return std::conj(at(-x, -y));
    const auto end = static_cast<double>(width);
    if (!(std::abs(x) < end && y < end))
        return 0;
    const auto weights = [this](double t) -> std::array<double, 4> {
        if (exact)
            return {0, 1 - t, t, 0};
        return {-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2,
                -(t + 1) * t * (t - 2) / 2, (t + 1) * t * (t - 1) / 6};
    };
    const double left = std::floor(x), below = std::floor(y);
    const std::array<double, 4> u = weights(x - left), v = weights(y - below);
    const int64_t i = static_cast<int64_t>(left) + width + margin - 1;
    const int64_t j = static_cast<int64_t>(below) + margin - 1;
    Complex sum = 0;
    for (int64_t b = 0; b < 4; ++b)
        for (int64_t a = 0; a < 4; ++a)
            sum += v[static_cast<size_t>(b)] * u[static_cast<size_t>(a)] * value(i + a, j + b);
    return sum;
}

Complex Otf::diffraction(double kx, double ky) const {
    Complex sum = 0;
    for (const Lattice &lattice : lattices_)
        sum += lattice.weight *
               lattice.at(kx * lattice.pixels_per_k, (mirrored_ ? -ky : ky) * lattice.pixels_per_k);
    return sum;
}

Complex Otf::effective(double kx, double ky) const {
    const Complex value = diffraction(kx, ky);
    if (value == 0.0) // also where the squares below would overflow
        return value;
    const double x = kx * pixel_scale_, y = ky * pixel_scale_;
    const double pixel = pixel_response_ ? sinc(x) * sinc(y) : 1;
    return value * pixel *
           std::exp(-2 * pi * pi * (blur_.xx * x * x + 2 * blur_.xy * x * y + blur_.yy * y * y));
}

// From the difference to pixels of twice the size, of which an error that falls as the square of
// the pixel is a third.
void Otf::estimate(std::span<const Component> components, int64_t n) {
    error_ = rounding;
    if (exact_)
        return;
    Otf coarse;
    coarse.mirrored_ = mirrored_;
    coarse.make(components, n / 2);
    constexpr int steps = 61;
    double difference = 0, whole = 0, largest = 0;
    for (int j = 0; j < steps; ++j)
        for (int i = -steps; i <= steps; ++i) {
            // Irregular against both lattices.
            const double kx = cutoff_ * std::remainder((i + 0.5) / steps + j * 0.618034, 2.0);
            const double ky = cutoff_ * (j + 0.29) / steps;
            const Complex fine = diffraction(kx, ky);
            const double off = std::abs(fine - coarse.diffraction(kx, ky));
            difference += off;
            whole += std::abs(fine);
            largest = std::max(largest, off);
        }
    error_ += difference / whole / 2;
    value_error_ += largest;
}

} // namespace wfpsf
