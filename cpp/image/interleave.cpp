// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/interleave.hpp"

#include "image/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace wfpsf {

namespace {

using Int = long long; // for printing

// The index along one axis of an image's samples among n.
int64_t phase_of(double offset, int64_t n, DitherConvention convention, size_t image,
                 const char *name) {
    if (!std::isfinite(offset))
        fail(WFPSF_ERROR_NOT_FINITE, "image %zu: %s = %g: must be finite", image, name, offset);
    const double count = static_cast<double>(n);
    const double position = convention == DitherConvention::detector
                                ? count * offset
                                : (count - 1) / 2 - count * offset;
    const double phase = std::round(position);
    if (std::fabs(position - phase) > dither_tolerance * count || phase < 0 || phase >= count) {
        const double first = convention == DitherConvention::detector ? 0 : (1 - count) / 2 / count;
        fail(WFPSF_ERROR_RANGE,
             "image %zu: %s = %.17g: must be %g + k/%lld pixel with k = 0..%lld, within %g", image,
             name, offset, first, static_cast<Int>(n), static_cast<Int>(n - 1), dither_tolerance);
    }
    return static_cast<int64_t>(phase);
}

void require_arguments(int64_t n, int64_t m, DitherConvention convention, InterleavedFlux flux) {
    if (n < 1 || m < 1)
        fail(WFPSF_ERROR_RANGE, "interleave of %lld x %lld images: must be at least 1 x 1",
             static_cast<Int>(n), static_cast<Int>(m));
    if (convention != DitherConvention::detector && convention != DitherConvention::object)
        fail(WFPSF_ERROR_ARGUMENT, "dither convention = %d: must be 0 or 1",
             static_cast<int>(convention));
    if (flux != InterleavedFlux::sum && flux != InterleavedFlux::mean)
        fail(WFPSF_ERROR_ARGUMENT, "interleaved flux = %d: must be 0 or 1", static_cast<int>(flux));
}

template <class T> void require_size(size_t image, View<T> pixels, int64_t nx, int64_t ny) {
    if (pixels.nx != nx || pixels.ny != ny)
        fail(WFPSF_ERROR_SIZE, "image %zu has %lld x %lld pixels: must have %lld x %lld", image,
             static_cast<Int>(pixels.nx), static_cast<Int>(pixels.ny), static_cast<Int>(nx),
             static_cast<Int>(ny));
}

// Which phases are taken, and by which image.
class PhaseTable {
  public:
    PhaseTable(int64_t n, int64_t m, DitherConvention convention)
        : n_(n), m_(m), convention_(convention) {}

    // The phase of an image, which no other may have.
    template <class T> std::pair<int64_t, int64_t> take(size_t k, const DitheredImage<T> &image) {
        const std::pair phase(phase_of(image.dx, n_, convention_, k, "dx"),
                              phase_of(image.dy, m_, convention_, k, "dy"));
        const auto [same, is_new] = images_.insert({phase, k});
        if (!is_new)
            fail(WFPSF_ERROR_ARGUMENT, "images %zu and %zu have the same phase, (%lld, %lld)",
                 same->second, k, static_cast<Int>(phase.first), static_cast<Int>(phase.second));
        return phase;
    }

  private:
    int64_t n_, m_;
    DitherConvention convention_;
    std::map<std::pair<int64_t, int64_t>, size_t> images_;
};

// Images that are written to must not share memory with each other: sorted by their first byte,
// each is held against those that begin before it ends.
template <class T> void require_apart(std::span<const DitheredImage<T>> images) {
    struct Extent {
        const T *first, *last;
        size_t image;
    };
    std::vector<Extent> extents;
    for (size_t k = 0; k < images.size(); ++k) {
        const View<T> v = images[k].pixels;
        if (v.empty())
            continue;
        const auto [x_low, x_high] = std::minmax({int64_t{0}, (v.nx - 1) * v.stride_x});
        const auto [y_low, y_high] = std::minmax({int64_t{0}, (v.ny - 1) * v.stride_y});
        extents.push_back({v.data + x_low + y_low, v.data + x_high + y_high, k});
    }
    std::sort(extents.begin(), extents.end(),
              [](const Extent &a, const Extent &b) { return std::less<>()(a.first, b.first); });
    for (size_t i = 0; i < extents.size(); ++i)
        for (size_t j = i + 1; j < extents.size() && extents[j].first <= extents[i].last; ++j)
            if (shares_memory(images[extents[i].image].pixels, images[extents[j].image].pixels))
                fail(WFPSF_ERROR_OVERLAP, "images %zu and %zu share memory", extents[i].image,
                     extents[j].image);
}

template <class A, class B> void require_apart(size_t image, View<A> pixels, View<B> interleaved) {
    if (shares_memory(pixels, interleaved))
        fail(WFPSF_ERROR_OVERLAP, "image %zu shares memory with the interleaved image", image);
}

template <class T>
void interleave_any(std::span<const DitheredImage<const T>> images, int64_t n, int64_t m,
                    DitherConvention convention, InterleavedFlux flux, View<T> out) {
    require_arguments(n, m, convention, flux);
    const int64_t count = static_cast<int64_t>(images.size());
    if (count % n != 0 || count / n != m)
        fail(WFPSF_ERROR_SIZE, "%lld images: must be %lld x %lld", static_cast<Int>(count),
             static_cast<Int>(n), static_cast<Int>(m));
    const int64_t nx = images[0].pixels.nx, ny = images[0].pixels.ny;
    if (out.nx % n != 0 || out.nx / n != nx || out.ny % m != 0 || out.ny / m != ny)
        fail(WFPSF_ERROR_SIZE,
             "out has %lld x %lld pixels: must have %lld x %lld times the images' %lld x %lld",
             static_cast<Int>(out.nx), static_cast<Int>(out.ny), static_cast<Int>(n),
             static_cast<Int>(m), static_cast<Int>(nx), static_cast<Int>(ny));

    PhaseTable taken(n, m, convention);
    std::vector<View<T>> phases;
    for (size_t k = 0; k < images.size(); ++k) {
        const DitheredImage<const T> &image = images[k];
        require_size(k, image.pixels, nx, ny);
        require_apart(k, image.pixels, out);
        const auto [i, j] = taken.take(k, image);
        phases.push_back(phase_view(out, n, m, i, j));
    }

    const double divisor = flux == InterleavedFlux::mean ? static_cast<double>(count) : 1.0;
    for (int64_t y = 0; y < ny; ++y)
        for (size_t k = 0; k < images.size(); ++k)
            for (int64_t x = 0; x < nx; ++x)
                phases[k](x, y) = static_cast<T>(images[k].pixels(x, y) / divisor);
}

template <class T>
void deinterleave_any(View<const T> interleaved, int64_t n, int64_t m, DitherConvention convention,
                      InterleavedFlux flux, std::span<const DitheredImage<T>> images) {
    require_arguments(n, m, convention, flux);
    const double factor =
        flux == InterleavedFlux::mean ? static_cast<double>(n) * static_cast<double>(m) : 1.0;
    PhaseTable taken(n, m, convention);
    std::vector<View<const T>> phases;
    for (size_t k = 0; k < images.size(); ++k) {
        const DitheredImage<T> &image = images[k];
        const auto [i, j] = taken.take(k, image);
        phases.push_back(phase_view(interleaved, n, m, i, j));
        require_size(k, image.pixels, phases[k].nx, phases[k].ny);
        require_apart(k, image.pixels, interleaved);
    }
    require_apart(images);
    for (size_t k = 0; k < images.size(); ++k)
        for (int64_t y = 0; y < phases[k].ny; ++y)
            for (int64_t x = 0; x < phases[k].nx; ++x)
                images[k].pixels(x, y) = static_cast<T>(phases[k](x, y) * factor);
}

} // namespace

void interleave(std::span<const DitheredImage<const float>> images, int64_t n, int64_t m,
                DitherConvention convention, InterleavedFlux flux, View<float> out) {
    interleave_any(images, n, m, convention, flux, out);
}

void interleave(std::span<const DitheredImage<const double>> images, int64_t n, int64_t m,
                DitherConvention convention, InterleavedFlux flux, View<double> out) {
    interleave_any(images, n, m, convention, flux, out);
}

void deinterleave(View<const float> interleaved, int64_t n, int64_t m, DitherConvention convention,
                  InterleavedFlux flux, std::span<const DitheredImage<float>> images) {
    deinterleave_any(interleaved, n, m, convention, flux, images);
}

void deinterleave(View<const double> interleaved, int64_t n, int64_t m, DitherConvention convention,
                  InterleavedFlux flux, std::span<const DitheredImage<double>> images) {
    deinterleave_any(interleaved, n, m, convention, flux, images);
}

} // namespace wfpsf
