// SPDX-License-Identifier: GPL-3.0-or-later
// The program of main.c in C++: handles that free themselves, errors as exceptions.
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <wfpsf/wfpsf.h>

namespace {

void check(wfpsf_status status) {
    if (status >= 0)
        return;
    std::string line(static_cast<std::size_t>(wfpsf_last_error(nullptr, 0)) + 1, '\0');
    wfpsf_last_error(line.data(), static_cast<std::int64_t>(line.size()));
    throw std::runtime_error(line);
}

template <auto destroy> struct Destroy {
    template <class T> void operator()(T *handle) const { destroy(handle); }
};
template <class T, auto destroy> using Handle = std::unique_ptr<T, Destroy<destroy>>;

// Calls a function whose last argument is the handle it makes.
template <class T, auto destroy, class... Given, class... Args>
Handle<T, destroy> make(wfpsf_status (*function)(Given...), Args... args) {
    T *handle = nullptr;
    const wfpsf_status status = function(args..., &handle);
    Handle<T, destroy> owned(handle);
    check(status);
    return owned;
}

} // namespace

int main(int argc, char **argv) {
    if (argc != 2 || std::string(argv[1]) != wfpsf_version())
        return 1;
    check(wfpsf_check_version());
    std::vector<double> pixels(64 * 64);
    const auto roman =
        make<wfpsf_instrument, wfpsf_instrument_destroy>(wfpsf_instrument_create, "roman-c9");
    const auto psf = make<wfpsf_psf, wfpsf_psf_destroy>(wfpsf_psf_create_in_band, roman.get(),
                                                        "H158", 4, 1000.0, 2000.0, 0.0, nullptr);
    const auto image = make<wfpsf_image, wfpsf_image_destroy>(wfpsf_image_wrap, WFPSF_FLOAT64,
                                                              pixels.data(), 64, 64, 1, 64, 4);
    check(wfpsf_psf_draw(psf.get(), 31.2, 32.1, 1000, nullptr, image.get()));
    const auto kernel = make<wfpsf_ipc_kernel, wfpsf_ipc_kernel_destroy>(
        wfpsf_ipc_kernel_create_default, roman.get());
    check(
        wfpsf_ipc_apply(kernel.get(), image.get(), WFPSF_EDGE_ZERO, nullptr, image.get(), nullptr));
    const auto moments =
        make<wfpsf_moments, wfpsf_moments_destroy>(wfpsf_moments_measure, image.get(), nullptr);
    double sigma = 0;
    check(wfpsf_moments_get(moments.get(), WFPSF_MOMENTS_SIGMA, &sigma));
    std::printf("sigma = %.9f\n", sigma);
    return 0;
}
