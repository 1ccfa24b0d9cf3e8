// SPDX-License-Identifier: GPL-3.0-or-later
// The C API's handles, freed by themselves; a call that fails throws the last-error line.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <wfpsf/wfpsf.h>

template <auto destroy> struct Destroy {
    void operator()(auto *handle) const { destroy(handle); }
};
template <class T, auto destroy> using Handle = std::unique_ptr<T, Destroy<destroy>>;

using Image = Handle<wfpsf_image, wfpsf_image_destroy>;
using Instrument = Handle<wfpsf_instrument, wfpsf_instrument_destroy>;
using Kernel = Handle<wfpsf_ipc_kernel, wfpsf_ipc_kernel_destroy>;
using Moments = Handle<wfpsf_moments, wfpsf_moments_destroy>;
using Options = Handle<wfpsf_options, wfpsf_options_destroy>;
using Psf = Handle<wfpsf_psf, wfpsf_psf_destroy>;

// Throws if the status is an error.
void require(wfpsf_status status);

// Pixels and the handle that looks at them.
struct Pixels {
    Pixels(int64_t width, int64_t height, int64_t oversampling = 1);
    double &operator()(int64_t x, int64_t y) { return data[static_cast<size_t>(y * nx + x)]; }
    double operator()(int64_t x, int64_t y) const { return data[static_cast<size_t>(y * nx + x)]; }

    int64_t nx, ny;
    std::vector<double> data;
    Image image;
};

// An image of the reference; hdu may be empty.
Pixels read_fits(const std::string &name, const std::string &hdu = "");

Instrument make_c5();
Options make_options();
Kernel make_kernel(double alpha, double alpha_prime, double alpha_plus);

// What a measurement found; x and y count from the first pixel's centre at 0.
struct Ellipse {
    wfpsf_status status = WFPSF_OK;
    double x = 0, y = 0, sigma = 0, e1 = 0, e2 = 0, flux = 0, rho4 = 0, Mxx = 0, Myy = 0, Mxy = 0;
};
Ellipse measure(const Pixels &pixels, const wfpsf_options *options = nullptr);
Ellipse measure_masked(const Pixels &pixels, const Pixels &missing, const wfpsf_options *options);
Ellipse measure_unweighted(const Pixels &pixels, double x, double y);
