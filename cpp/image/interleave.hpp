// SPDX-License-Identifier: GPL-3.0-or-later
// N x M native images, dithered by fractions of a pixel, and the one image of N x M times their
// sampling that they make (Kannawadi et al. 2016, Eqs. 27 and 28). Both hold the response of the
// native pixel.
#pragma once

#include "error/error.hpp"
#include "image/view.hpp"

#include <span>

namespace wfpsf {

// What moved by (dx, dy) native pixels from image to image, and where that puts the image: its
// pixel x goes to output sample N x + i.
enum class DitherConvention : int32_t {
    detector = 0, // the detector, as in the paper: i = N dx, so dx = 0, 1/N, ..., (N-1)/N
    object = 1,   // the object: i = (N-1)/2 - N dx, so dx = (N-1)/(2N), ..., -(N-1)/(2N)
};

// An offset must be one of these within this many native pixels.
inline constexpr double dither_tolerance = 1e-8;

// The flux of the interleaved image against those of the native ones.
enum class InterleavedFlux : int32_t {
    sum = 0,  // pixels are taken as they are
    mean = 1, // pixels are divided by N M
};

template <class T> struct DitheredImage {
    View<T> pixels;
    double dx = 0, dy = 0;
};

// The native image of phase (i, j), 0 <= i < n, 0 <= j < m: samples (n x + i, m y + j) of an
// interleaved image, in place.
template <class T>
View<T> phase_view(View<T> interleaved, int64_t n, int64_t m, int64_t i, int64_t j) {
    if (n < 1 || m < 1)
        fail(WFPSF_ERROR_RANGE, "interleave of %lld x %lld images: must be at least 1 x 1",
             static_cast<long long>(n), static_cast<long long>(m));
    if (i < 0 || i >= n || j < 0 || j >= m)
        fail(WFPSF_ERROR_RANGE, "phase (%lld, %lld): must be 0..%lld, 0..%lld",
             static_cast<long long>(i), static_cast<long long>(j), static_cast<long long>(n - 1),
             static_cast<long long>(m - 1));
    const int64_t nx = i < interleaved.nx ? (interleaved.nx - i - 1) / n + 1 : 0;
    const int64_t ny = j < interleaved.ny ? (interleaved.ny - j - 1) / m + 1 : 0;
    T *data = nx == 0 || ny == 0 ? interleaved.data : &interleaved(i, j);
    return {data, nx, ny, n * interleaved.stride_x, m * interleaved.stride_y};
}

// out, of n nx by m ny samples, from n m images of nx x ny pixels, one of each phase, in any order.
// The offset of each image says which phase it is. out must not share memory with an image.
void interleave(std::span<const DitheredImage<const float>> images, int64_t n, int64_t m,
                DitherConvention convention, InterleavedFlux flux, View<float> out);
void interleave(std::span<const DitheredImage<const double>> images, int64_t n, int64_t m,
                DitherConvention convention, InterleavedFlux flux, View<double> out);

// The inverse: copies out the images of the given offsets, as many as are wanted. They must not
// share memory with each other.
void deinterleave(View<const float> interleaved, int64_t n, int64_t m, DitherConvention convention,
                  InterleavedFlux flux, std::span<const DitheredImage<float>> images);
void deinterleave(View<const double> interleaved, int64_t n, int64_t m, DitherConvention convention,
                  InterleavedFlux flux, std::span<const DitheredImage<double>> images);

} // namespace wfpsf
