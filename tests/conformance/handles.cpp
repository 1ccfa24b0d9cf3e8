// SPDX-License-Identifier: GPL-3.0-or-later
#include "handles.hpp"

#include "csv.hpp"

#include <stdexcept>

void require(wfpsf_status status) {
    if (status >= 0)
        return;
    char line[1024];
    wfpsf_last_error(line, sizeof line);
    throw std::runtime_error(std::string(wfpsf_status_name(status)) + ": " + line);
}

Pixels::Pixels(int64_t width, int64_t height, int64_t oversampling)
    : nx(width), ny(height), data(static_cast<size_t>(width * height)) {
    wfpsf_image *handle = nullptr;
    require(wfpsf_image_wrap(WFPSF_FLOAT64, data.data(), nx, ny, 1, nx, oversampling, &handle));
    image.reset(handle);
}

Pixels read_fits(const std::string &name, const std::string &hdu) {
    wfpsf_image *handle = nullptr;
    require(wfpsf_image_read_fits(reference_path(name).c_str(), hdu.empty() ? nullptr : hdu.c_str(),
                                  WFPSF_FLOAT64, &handle));
    const Image read(handle);
    int64_t nx = 0, ny = 0;
    require(wfpsf_image_shape(read.get(), nullptr, &nx, &ny));
    Pixels pixels(nx, ny);
    require(wfpsf_image_copy(read.get(), pixels.image.get()));
    return pixels;
}

Instrument make_c5() {
    wfpsf_instrument *handle = nullptr;
    require(wfpsf_instrument_create("wfirst-afta-c5", &handle));
    return Instrument(handle);
}

Options make_options() {
    wfpsf_options *handle = nullptr;
    require(wfpsf_options_create(&handle));
    return Options(handle);
}

Kernel make_kernel(double alpha, double alpha_prime, double alpha_plus) {
    wfpsf_ipc_kernel *handle = nullptr;
    require(wfpsf_ipc_kernel_create(alpha, alpha_prime, alpha_plus, nullptr, &handle));
    return Kernel(handle);
}

namespace {

Ellipse ellipse_of(const Moments &moments) {
    const auto get = [&](int32_t key) {
        double value = 0;
        require(wfpsf_moments_get(moments.get(), key, &value));
        return value;
    };
    return {.status = wfpsf_moments_status(moments.get()),
            .x = get(WFPSF_MOMENTS_CENTROID_X),
            .y = get(WFPSF_MOMENTS_CENTROID_Y),
            .sigma = get(WFPSF_MOMENTS_SIGMA),
            .e1 = get(WFPSF_MOMENTS_E1),
            .e2 = get(WFPSF_MOMENTS_E2),
            .flux = get(WFPSF_MOMENTS_FLUX),
            .rho4 = get(WFPSF_MOMENTS_RHO4),
            .Mxx = get(WFPSF_MOMENTS_MXX),
            .Myy = get(WFPSF_MOMENTS_MYY),
            .Mxy = get(WFPSF_MOMENTS_MXY)};
}

} // namespace

Ellipse measure(const Pixels &pixels, const wfpsf_options *options) {
    wfpsf_moments *handle = nullptr;
    wfpsf_moments_measure(pixels.image.get(), options, &handle);
    return ellipse_of(Moments(handle)); // a failure is told by the result's status
}

Ellipse measure_masked(const Pixels &pixels, const Pixels &missing, const wfpsf_options *options) {
    wfpsf_moments *handle = nullptr;
    wfpsf_moments_measure_masked(pixels.image.get(), missing.image.get(), nullptr, options,
                                 &handle);
    return ellipse_of(Moments(handle));
}

Ellipse measure_unweighted(const Pixels &pixels, double x, double y) {
    wfpsf_moments *handle = nullptr;
    require(wfpsf_moments_measure_unweighted(pixels.image.get(), x, y, &handle));
    return ellipse_of(Moments(handle));
}
