// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/convolve.hpp"

#include "error/error.hpp"
#include "numerics/fft.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

namespace wfpsf {

namespace {

using Complex = std::complex<double>;

constexpr int64_t longest_side = 8192; // of the PSF's stamp, samples

// The samples, divided by the largest of them.
template <class S> Plane<double> scaled(View<const S> samples, double &largest) {
    largest = 0;
    for (int64_t y = 0; y < samples.ny; ++y)
        for (int64_t x = 0; x < samples.nx; ++x) {
            const auto value = static_cast<double>(samples(x, y));
            if (!std::isfinite(value))
                fail(WFPSF_ERROR_NOT_FINITE, "galaxy sample (%lld, %lld) = %g: must be finite",
                     static_cast<long long>(x), static_cast<long long>(y), value);
            largest = std::max(largest, std::abs(value));
        }
    Plane<double> out(samples.nx, samples.ny);
    if (largest > 0)
        for (int64_t y = 0; y < samples.ny; ++y)
            for (int64_t x = 0; x < samples.nx; ++x)
                out(x, y) = static_cast<double>(samples(x, y)) / largest;
    return out;
}

// Valid part of the convolution, every step-th sample:
// out(i, j) = sum over a, b of source(a, b) stamp(step i + nx - 1 - a, step j + ny - 1 - b).
template <class Store>
void sum_directly(const Plane<double> &source, const Plane<double> &stamp, int64_t step,
                  int64_t out_nx, int64_t out_ny, Store store) {
    for (int64_t j = 0; j < out_ny; ++j)
        for (int64_t i = 0; i < out_nx; ++i) {
            double sum = 0;
            for (int64_t b = 0; b < source.ny(); ++b)
                for (int64_t a = 0; a < source.nx(); ++a)
                    sum += source(a, b) *
                           stamp(step * i + source.nx() - 1 - a, step * j + source.ny() - 1 - b);
            store(i, j, sum);
        }
}

// The same by FFT: both real images in one complex one, whose transform is taken apart by its
// symmetry. The period holds the stamp, so what wraps around falls outside the valid part.
template <class Store>
void sum_by_fft(const Plane<double> &source, const Plane<double> &stamp, int64_t step,
                int64_t out_nx, int64_t out_ny, int64_t nx, int64_t ny, Store store) {
    double peak = 0;
    for (int64_t y = 0; y < stamp.ny(); ++y)
        for (int64_t x = 0; x < stamp.nx(); ++x)
            peak = std::max(peak, std::abs(stamp(x, y)));
    if (peak == 0)
        peak = 1;
    Plane<Complex> both(nx, ny);
    for (int64_t y = 0; y < stamp.ny(); ++y)
        for (int64_t x = 0; x < stamp.nx(); ++x)
            both(x, y).real(stamp(x, y) / peak);
    for (int64_t y = 0; y < source.ny(); ++y)
        for (int64_t x = 0; x < source.nx(); ++x)
            both(x, y).imag(source(x, y));
    const BackwardFft2d fft(nx, ny);
    fft.run(both.view().data);
    for (int64_t y = 0; y <= ny / 2; ++y)
        for (int64_t x = 0; x < nx; ++x) {
            // With (s + i g)(k) = z and conj (s + i g)(-k) = w: s g = (z^2 - w^2) / 4i.
            Complex &here = both(x, y), &there = both((nx - x) % nx, (ny - y) % ny);
            if (y == (ny - y) % ny && x > (nx - x) % nx)
                continue; // done from the other side
            const Complex z = here, w = std::conj(there);
            here = (z - w) * (z + w) / Complex(0, 4);
            there = std::conj(here);
        }
    fft.run(both.view().data); // backwards again: the result is turned round
    const double scale = peak / (static_cast<double>(nx) * static_cast<double>(ny));
    for (int64_t j = 0; j < out_ny; ++j)
        for (int64_t i = 0; i < out_nx; ++i)
            store(i, j,
                  scale * both((2 * nx - (step * i + source.nx() - 1)) % nx,
                               (2 * ny - (step * j + source.ny() - 1)) % ny)
                              .real());
}

} // namespace

template <class S, class T>
void convolve(const Psf &psf, const Source<S> &source, int64_t oversampling, View<T> out) {
    if (source.oversampling % oversampling != 0)
        fail(WFPSF_ERROR_ARGUMENT,
             "galaxy: has %lld samples a native pixel: must be a multiple of the image's %lld",
             static_cast<long long>(source.oversampling), static_cast<long long>(oversampling));
    double largest = 0;
    const Plane<double> samples = scaled(source.samples, largest);
    if (out.empty())
        return;
    if (largest == 0) {
        for (int64_t y = 0; y < out.ny; ++y)
            for (int64_t x = 0; x < out.nx; ++x)
                out(x, y) = 0;
        return;
    }
    // The PSF from every sample of the source to every pixel of the image.
    const int64_t step = source.oversampling / oversampling;
    if (out.nx > longest_side / step || out.ny > longest_side / step ||
        step * out.nx + samples.nx() > longest_side || step * out.ny + samples.ny() > longest_side)
        fail(WFPSF_ERROR_SIZE,
             "galaxy and image: %lld x %lld and %lld x %lld samples: together at most %lld a side",
             static_cast<long long>(samples.nx()), static_cast<long long>(samples.ny()),
             static_cast<long long>(out.nx), static_cast<long long>(out.ny),
             static_cast<long long>(longest_side));
    Plane<double> stamp(step * (out.nx - 1) + samples.nx(), step * (out.ny - 1) + samples.ny());
    const auto place = [step](double position, int64_t size) {
        return static_cast<double>(step) * position + static_cast<double>(size - 1) / 2;
    };
    const auto finer = static_cast<double>(step * step);
    psf.draw({place(source.x, samples.nx()), place(source.y, samples.ny()), finer},
             source.oversampling, stamp.view());

    const auto store = [&](int64_t x, int64_t y, double sum) {
        out(x, y) = static_cast<T>(source.flux * largest * sum);
    };
    const int64_t nx = good_fft_length(stamp.nx()), ny = good_fft_length(stamp.ny());
    const double terms =
        static_cast<double>(out.nx * out.ny) * static_cast<double>(samples.nx() * samples.ny());
    const double points = static_cast<double>(nx) * static_cast<double>(ny);
    if (terms < 5 * points * std::log2(points + 1))
        sum_directly(samples, stamp, step, out.nx, out.ny, store);
    else
        sum_by_fft(samples, stamp, step, out.nx, out.ny, nx, ny, store);
}

template void convolve(const Psf &, const Source<float> &, int64_t, View<float>);
template void convolve(const Psf &, const Source<float> &, int64_t, View<double>);
template void convolve(const Psf &, const Source<double> &, int64_t, View<float>);
template void convolve(const Psf &, const Source<double> &, int64_t, View<double>);

} // namespace wfpsf
