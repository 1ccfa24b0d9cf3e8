// SPDX-License-Identifier: GPL-3.0-or-later
#include "funnel.hpp"
#include "handles.hpp"
#include "image/fits.hpp"
#include "image/interleave.hpp"
#include "image/overlap.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <variant>

namespace wfpsf {

PixelType pixel_type_of(int32_t pixel_type) {
    if (pixel_type == WFPSF_FLOAT32)
        return PixelType::float32;
    if (pixel_type == WFPSF_FLOAT64)
        return PixelType::float64;
    fail(WFPSF_ERROR_ARGUMENT, "pixel_type = %d: must be WFPSF_FLOAT32 or WFPSF_FLOAT64",
         pixel_type);
}

Plane<double> copy_of(const wfpsf_image &image) {
    return std::visit(
        [](auto pixels) {
            Plane<double> copy(pixels.nx, pixels.ny);
            for (int64_t y = 0; y < pixels.ny; ++y)
                for (int64_t x = 0; x < pixels.nx; ++x)
                    copy(x, y) = static_cast<double>(pixels(x, y));
            return copy;
        },
        image.image.pixels());
}

namespace {

int oversampling_of(int64_t oversampling) {
    if (oversampling < 1 || oversampling > std::numeric_limits<int>::max())
        fail(WFPSF_ERROR_RANGE, "oversampling = %lld: must be 1..2147483647",
             static_cast<long long>(oversampling));
    return static_cast<int>(oversampling);
}

void copy_record(const Image &from, Image &to) {
    to.set_oversampling(from.oversampling());
    to.set_pixel_scale_arcsec(from.pixel_scale_arcsec());
    to.set_applied(from.applied());
}

void copy_pixels(const Image &from, Image &to) {
    std::visit(
        [](auto source, auto target) {
            if (shares_memory(source, target))
                fail(WFPSF_ERROR_OVERLAP, "to: shares memory with from");
            using Pixel = std::remove_reference_t<decltype(*target.data)>;
            for (int64_t y = 0; y < target.ny; ++y)
                for (int64_t x = 0; x < target.nx; ++x)
                    target(x, y) = static_cast<Pixel>(source(x, y));
        },
        from.pixels(), to.pixels());
}

// An HDU by number or name.
FitsHdu hdu_of(const char *hdu) {
    char *end = nullptr;
    const long number = std::strtol(hdu, &end, 10);
    if (end != hdu && *end == '\0' && number >= 0 && number < 100000)
        return {.number = static_cast<int>(number), .name = {}};
    return {.number = {}, .name = hdu};
}

DitherConvention convention_of(int32_t convention) {
    if (convention == WFPSF_DITHER_DETECTOR)
        return DitherConvention::detector;
    if (convention == WFPSF_DITHER_OBJECT)
        return DitherConvention::object;
    fail(WFPSF_ERROR_ARGUMENT, "convention = %d: must be WFPSF_DITHER_DETECTOR or _OBJECT",
         convention);
}

int64_t dither_count(int64_t n_x, int64_t n_y, const double *dx, const double *dy) {
    if (n_x < 1 || n_y < 1 || n_x > 4096 || n_y > 4096)
        fail(WFPSF_ERROR_RANGE, "(n_x, n_y) = (%lld, %lld): must be 1..4096",
             static_cast<long long>(n_x), static_cast<long long>(n_y));
    require_pointer(dx, "dx");
    require_pointer(dy, "dy");
    return n_x * n_y;
}

// The pixels of a list of images that must all be of one type.
template <class T, class Handle>
std::vector<DitheredImage<T>> dithered(Handle *const *images, const char *argument, int64_t count,
                                       const double *dx, const double *dy) {
    std::vector<DitheredImage<T>> list;
    for (int64_t k = 0; k < count; ++k) {
        if (!images[k])
            fail(WFPSF_ERROR_NULL, "%s[%lld] = NULL: must point to an image", argument,
                 static_cast<long long>(k));
        auto pixels = images[k]->image.pixels();
        const auto *view = std::get_if<View<T>>(&pixels);
        if (!view)
            fail(WFPSF_ERROR_TYPE, "%s[%lld]: must have the pixel type of the fine image", argument,
                 static_cast<long long>(k));
        list.push_back({*view, dx[k], dy[k]});
    }
    return list;
}

} // namespace

} // namespace wfpsf

using namespace wfpsf;

wfpsf_status wfpsf_image_create(int32_t pixel_type, int64_t nx, int64_t ny, int64_t oversampling,
                                wfpsf_image **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        const int samples = oversampling_of(oversampling);
        auto *image = new wfpsf_image{Image(pixel_type_of(pixel_type), nx, ny)};
        image->image.set_oversampling(samples);
        *out = image;
    });
}

wfpsf_status wfpsf_image_wrap(int32_t pixel_type, void *data, int64_t nx, int64_t ny,
                              int64_t stride_x, int64_t stride_y, int64_t oversampling,
                              wfpsf_image **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        const int samples = oversampling_of(oversampling);
        if (nx > 0 && ny > 0)
            require_pointer(data, "data");
        auto *image = new wfpsf_image{
            Image::wrap(pixel_type_of(pixel_type), data, nx, ny, stride_x, stride_y)};
        image->image.set_oversampling(samples);
        *out = image;
    });
}

void wfpsf_image_destroy(wfpsf_image *image) {
    delete image;
}

wfpsf_status wfpsf_image_shape(const wfpsf_image *image, int32_t *pixel_type, int64_t *nx,
                               int64_t *ny) {
    return guarded([&] {
        require_pointer(image, "image");
        if (pixel_type)
            *pixel_type = image->image.type() == PixelType::float32 ? WFPSF_FLOAT32 : WFPSF_FLOAT64;
        if (nx)
            *nx = image->image.nx();
        if (ny)
            *ny = image->image.ny();
    });
}

wfpsf_status wfpsf_image_record(const wfpsf_image *image, int64_t *oversampling,
                                double *pixel_scale_arcsec, int32_t *applied) {
    return guarded([&] {
        require_pointer(image, "image");
        if (oversampling)
            *oversampling = image->image.oversampling();
        if (pixel_scale_arcsec)
            *pixel_scale_arcsec = image->image.pixel_scale_arcsec();
        if (applied)
            *applied = static_cast<int32_t>(image->image.applied());
    });
}

wfpsf_status wfpsf_image_set_record(wfpsf_image *image, int64_t oversampling,
                                    double pixel_scale_arcsec, int32_t applied) {
    return guarded([&] {
        require_pointer(image, "image");
        const int samples = oversampling_of(oversampling);
        if (!std::isfinite(pixel_scale_arcsec))
            fail(WFPSF_ERROR_NOT_FINITE, "pixel_scale_arcsec = %g: must be finite",
                 pixel_scale_arcsec);
        if (pixel_scale_arcsec < 0)
            fail(WFPSF_ERROR_RANGE, "pixel_scale_arcsec = %g: must be >= 0", pixel_scale_arcsec);
        if (static_cast<uint32_t>(applied) & ~all_effects)
            fail(WFPSF_ERROR_ARGUMENT, "applied = %d: must be a sum of WFPSF_EFFECT_*", applied);
        image->image.set_oversampling(samples);
        image->image.set_pixel_scale_arcsec(pixel_scale_arcsec);
        image->image.set_applied(static_cast<uint32_t>(applied));
    });
}

wfpsf_status wfpsf_image_copy(const wfpsf_image *from, wfpsf_image *to) {
    return guarded([&] {
        require_pointer(from, "from");
        require_pointer(to, "to");
        const Image &source = from->image;
        if (source.nx() != to->image.nx() || source.ny() != to->image.ny())
            fail(WFPSF_ERROR_SIZE, "to: %lld x %lld pixels, must be %lld x %lld like from",
                 static_cast<long long>(to->image.nx()), static_cast<long long>(to->image.ny()),
                 static_cast<long long>(source.nx()), static_cast<long long>(source.ny()));
        copy_pixels(source, to->image);
        copy_record(source, to->image);
    });
}

wfpsf_status wfpsf_image_read_fits(const char *path, const char *hdu, int32_t pixel_type,
                                   wfpsf_image **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(path, "path");
        std::optional<PixelType> type;
        if (pixel_type != 0)
            type = pixel_type_of(pixel_type);
        *out = new wfpsf_image{read_fits(path, hdu ? hdu_of(hdu) : FitsHdu{}, type)};
    });
}

wfpsf_status wfpsf_image_write_fits(const wfpsf_image *image, const char *path,
                                    const wfpsf_options *options) {
    return guarded([&] {
        require_pointer(image, "image");
        require_pointer(path, "path");
        write_fits(path, image->image, flag(options, WFPSF_OPTION_FITS_OVERWRITE));
    });
}

wfpsf_status wfpsf_image_interleave(int64_t n_x, int64_t n_y, const wfpsf_image *const *images,
                                    const double *dx, const double *dy, int32_t convention,
                                    wfpsf_image *out) {
    return guarded([&] {
        const int64_t count = dither_count(n_x, n_y, dx, dy);
        require_pointer(images, "images");
        require_pointer(out, "out");
        const DitherConvention rule = convention_of(convention);
        std::visit(
            [&](auto fine) {
                using Pixel = std::remove_reference_t<decltype(*fine.data)>;
                const auto list = dithered<const Pixel>(images, "images", count, dx, dy);
                interleave(list, n_x, n_y, rule, InterleavedFlux::sum, fine);
            },
            out->image.pixels());
        const int64_t before = out->image.oversampling();
        copy_record(images[0]->image, out->image);
        out->image.set_oversampling(
            oversampling_of(n_x == n_y ? images[0]->image.oversampling() * n_x : before));
    });
}

wfpsf_status wfpsf_image_deinterleave(const wfpsf_image *image, int64_t n_x, int64_t n_y,
                                      const double *dx, const double *dy, int32_t convention,
                                      wfpsf_image *const *out) {
    return guarded([&] {
        require_pointer(image, "image");
        const int64_t count = dither_count(n_x, n_y, dx, dy);
        require_pointer(out, "out");
        const DitherConvention rule = convention_of(convention);
        const Image &fine = image->image;
        if (n_x == n_y && fine.oversampling() % n_x != 0)
            fail(WFPSF_ERROR_ARGUMENT, "n_x = %lld: must divide the image's oversampling %d",
                 static_cast<long long>(n_x), fine.oversampling());
        std::visit(
            [&](auto pixels) {
                using Pixel = std::remove_const_t<std::remove_reference_t<decltype(*pixels.data)>>;
                const auto list = dithered<Pixel>(out, "out", count, dx, dy);
                deinterleave(pixels, n_x, n_y, rule, InterleavedFlux::sum, list);
            },
            fine.pixels());
        for (int64_t k = 0; k < count; ++k) {
            copy_record(fine, out[k]->image);
            if (n_x == n_y)
                out[k]->image.set_oversampling(fine.oversampling() / static_cast<int>(n_x));
        }
    });
}
