// SPDX-License-Identifier: GPL-3.0-or-later
// What stands behind the opaque handles.
#pragma once

#include "detector/chain.hpp"
#include "detector/ipc_kernel.hpp"
#include "image/image.hpp"
#include "instrument/instrument.hpp"
#include "optics/psf.hpp"

#include <array>
#include <utility>
#include <vector>

#include <wfpsf/wfpsf.h>

struct wfpsf_image {
    wfpsf::Image image;
};

struct wfpsf_instrument {
    const wfpsf::Instrument &instrument;
};

struct wfpsf_psf {
    wfpsf::Psf psf;
    double wavelength_nm, pixel_scale_arcsec; // as given, without a rounding
};

struct wfpsf_ipc_kernel {
    wfpsf::IpcKernel kernel;
    wfpsf::Effect effect; // what its application is recorded as
};

struct wfpsf_chain {
    wfpsf::Chain chain;
};

struct wfpsf_moments {
    wfpsf_status status;
    std::vector<std::pair<int32_t, double>> properties; // by key
};

namespace wfpsf {

// The value of an option; the default if options is NULL.
double option(const wfpsf_options *options, int32_t key);
bool flag(const wfpsf_options *options, int32_t key);

// The extra Zernike coefficients; none if options is NULL.
const std::vector<double> &extra_zernikes(const wfpsf_options *options);

PixelType pixel_type_of(int32_t pixel_type);

} // namespace wfpsf
