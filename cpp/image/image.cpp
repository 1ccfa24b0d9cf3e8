// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/image.hpp"

#include "error/error.hpp"

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstddef>
#include <new>
#include <numeric>

namespace wfpsf {

namespace {

size_t bytes_per_pixel(PixelType type) {
    return type == PixelType::float32 ? sizeof(float) : sizeof(double);
}

Image::Pixels make_view(PixelType type, void *data, int64_t nx, int64_t ny, int64_t stride_x,
                        int64_t stride_y) {
    if (type == PixelType::float32)
        return View<float>{static_cast<float *>(data), nx, ny, stride_x, stride_y};
    return View<double>{static_cast<double *>(data), nx, ny, stride_x, stride_y};
}

void require_sizes(PixelType type, int64_t nx, int64_t ny) {
    if (nx < 0)
        fail(WFPSF_ERROR_SIZE, "nx = %" PRId64 ": must be >= 0", nx);
    if (ny < 0)
        fail(WFPSF_ERROR_SIZE, "ny = %" PRId64 ": must be >= 0", ny);
    int64_t pixels, bytes;
    if (__builtin_mul_overflow(nx, ny, &pixels) ||
        __builtin_mul_overflow(pixels, static_cast<int64_t>(bytes_per_pixel(type)), &bytes))
        fail(WFPSF_ERROR_SIZE, "nx * ny = %" PRId64 " * %" PRId64 ": must fit in memory", nx, ny);
}

uint64_t magnitude(int64_t stride) {
    return stride < 0 ? 0 - static_cast<uint64_t>(stride) : static_cast<uint64_t>(stride);
}

// Strides that keep every pixel's address within 63 bits and apart from every other pixel's.
void require_strides(PixelType type, int64_t nx, int64_t ny, int64_t stride_x, int64_t stride_y) {
    const uint64_t step_x = magnitude(stride_x), step_y = magnitude(stride_y);
    const uint64_t last_x = static_cast<uint64_t>(nx) - 1, last_y = static_cast<uint64_t>(ny) - 1;
    uint64_t extent_x, extent_y, extent;
    if (__builtin_mul_overflow(std::max<uint64_t>(last_x, 1), step_x, &extent_x) ||
        __builtin_mul_overflow(std::max<uint64_t>(last_y, 1), step_y, &extent_y) ||
        __builtin_add_overflow(extent_x, extent_y, &extent) ||
        extent >= static_cast<uint64_t>(PTRDIFF_MAX) / bytes_per_pixel(type))
        fail(WFPSF_ERROR_SIZE,
             "stride_x = %" PRId64 ", stride_y = %" PRId64 ": the pixels must span less than 2^63 "
             "bytes",
             stride_x, stride_y);
    if (last_x > 0 && stride_x == 0)
        fail(WFPSF_ERROR_SIZE, "stride_x = 0: must not be 0 when nx = %" PRId64, nx);
    if (last_y > 0 && stride_y == 0)
        fail(WFPSF_ERROR_SIZE, "stride_y = 0: must not be 0 when ny = %" PRId64, ny);
    if (last_x == 0 || last_y == 0)
        return;
    // The smallest steps (dx, dy) with dx * stride_x + dy * stride_y = 0.
    const uint64_t divisor = std::gcd(step_x, step_y);
    if (step_y / divisor <= last_x && step_x / divisor <= last_y)
        fail(WFPSF_ERROR_SIZE,
             "stride_x = %" PRId64 ", stride_y = %" PRId64 ": two pixels of %" PRId64 " x %" PRId64
             " would share memory",
             stride_x, stride_y, nx, ny);
}

} // namespace

const char *effect_name(Effect effect) {
    switch (effect) {
    case Effect::pixel_response:
        return "pixel response";
    case Effect::ipc:
        return "interpixel capacitance";
    case Effect::ipc_correction:
        return "correction of interpixel capacitance";
    case Effect::charge_diffusion:
        return "charge diffusion";
    case Effect::background:
        return "background";
    case Effect::poisson_noise:
        return "Poisson noise";
    case Effect::reciprocity_failure:
        return "reciprocity failure";
    case Effect::dark_current:
        return "dark current";
    case Effect::persistence:
        return "persistence";
    case Effect::nonlinearity:
        return "nonlinearity";
    case Effect::nonlinearity_correction:
        return "correction of nonlinearity";
    case Effect::capacitance:
        return "capacitance of the pixels";
    case Effect::read_noise:
        return "read noise";
    case Effect::gain:
        return "gain";
    case Effect::none:
        break;
    }
    return "one of several effects at once";
}

Image::Image(PixelType type, int64_t nx, int64_t ny) {
    require_sizes(type, nx, ny);
    if (nx > 0 && ny > 0) {
        storage_.reset(std::calloc(static_cast<size_t>(nx * ny), bytes_per_pixel(type)));
        if (!storage_)
            throw std::bad_alloc();
    }
    pixels_ = make_view(type, storage_.get(), nx, ny, 1, nx);
}

Image Image::wrap(PixelType type, void *data, int64_t nx, int64_t ny, int64_t stride_x,
                  int64_t stride_y) {
    require_sizes(type, nx, ny);
    if (nx > 0 && ny > 0) {
        if (!data)
            fail(WFPSF_ERROR_NULL, "data = NULL: must point to %" PRId64 " x %" PRId64 " pixels",
                 nx, ny);
        if (reinterpret_cast<uintptr_t>(data) % bytes_per_pixel(type) != 0)
            fail(WFPSF_ERROR_ARGUMENT, "data = %p: must be aligned to %zu bytes", data,
                 bytes_per_pixel(type));
        require_strides(type, nx, ny, stride_x, stride_y);
    }
    return Image(make_view(type, data, nx, ny, stride_x, stride_y));
}

PixelType Image::type() const {
    return std::holds_alternative<View<float>>(pixels_) ? PixelType::float32 : PixelType::float64;
}

int64_t Image::nx() const {
    return std::visit([](const auto &view) { return view.nx; }, pixels_);
}

int64_t Image::ny() const {
    return std::visit([](const auto &view) { return view.ny; }, pixels_);
}

Image::ConstPixels Image::pixels() const {
    if (const auto *view = std::get_if<View<float>>(&pixels_))
        return View<const float>(*view);
    return View<const double>(std::get<View<double>>(pixels_));
}

void Image::set_oversampling(int oversampling) {
    if (oversampling < 1)
        fail(WFPSF_ERROR_RANGE, "oversampling = %d: must be >= 1", oversampling);
    oversampling_ = oversampling;
}

void Image::set_pixel_scale_arcsec(double scale) {
    if (!std::isfinite(scale))
        fail(WFPSF_ERROR_NOT_FINITE, "pixel_scale_arcsec = %g: must be finite", scale);
    if (scale < 0)
        fail(WFPSF_ERROR_RANGE, "pixel_scale_arcsec = %g: must be > 0, or 0 where not stated",
             scale);
    pixel_scale_arcsec_ = scale;
}

void Image::require_not_applied(Effect effect, bool force) const {
    if (!force && is_applied(effect))
        fail(WFPSF_ERROR_ALREADY_APPLIED, "image: %s was applied before; force it to apply again",
             effect_name(effect));
}

} // namespace wfpsf
