// SPDX-License-Identifier: GPL-3.0-or-later
// What stands behind the opaque handles.
#pragma once

#include "detector/chain.hpp"
#include "detector/ipc_kernel.hpp"
#include "detector/varying_ipc.hpp"
#include "image/image.hpp"
#include "instrument/instrument.hpp"
#include "moments/adaptive.hpp"
#include "moments/covariance.hpp"
#include "moments/pixel_moments.hpp"
#include "observation/observation.hpp"
#include "optics/otf.hpp"
#include "optics/psf.hpp"
#include "optics/varying_psf.hpp"
#include "scene/catalogue.hpp"
#include "scene/exposure.hpp"
#include "scene/plan.hpp"
#include "scene/render.hpp"
#include "study/study.hpp"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include <wfpsf/wfpsf.h>

struct wfpsf_image {
    wfpsf::Image image;
};

struct wfpsf_instrument {
    std::shared_ptr<const wfpsf::Instrument> owned; // none if it is compiled in
    const wfpsf::Instrument &instrument;
};

struct wfpsf_observation {
    wfpsf::Observation observation;
};

struct wfpsf_sed {
    wfpsf::Sed sed;
};

struct wfpsf_psf {
    wfpsf::Psf psf;
    double wavelength_nm, pixel_scale_arcsec; // as given, without a rounding
};

struct wfpsf_varying_psf {
    wfpsf::VaryingPsf varying;
    double wavelength_nm, pixel_scale_arcsec;
};

struct wfpsf_otf {
    wfpsf::Otf otf;
};

struct wfpsf_ipc_kernel {
    wfpsf::IpcKernel kernel;
    wfpsf::Effect effect; // what its application is recorded as
};

struct wfpsf_varying_ipc {
    std::shared_ptr<const wfpsf::VaryingIpc> ipc; // chains share it
};

struct wfpsf_chain {
    wfpsf::Chain chain;
};

struct wfpsf_moments {
    wfpsf_status status;
    std::vector<std::pair<int32_t, double>> properties; // by key

    // How it was measured, for its derivatives: as the solution of a fit, or from sums. None for a
    // result that is a derivative.
    struct Fit {
        wfpsf::AdaptiveOptions options;
        wfpsf::AdaptiveMoments solution;
        std::shared_ptr<const wfpsf::Plane<float>> missing;
    };
    struct Sums {
        double x, y;
        std::optional<wfpsf::Gaussian> weight;
        wfpsf::Centre centre;
    };
    std::variant<std::monostate, Fit, Sums> origin = {};
    int64_t nx = 0, ny = 0;

    std::optional<wfpsf::MomentsCovariance> covariance = {};
};

struct wfpsf_catalogue {
    wfpsf::Catalogue catalogue;
};

struct wfpsf_scene_store {
    std::shared_ptr<wfpsf::SceneStore> store; // options and scenes share it
};

struct wfpsf_scene {
    wfpsf::SceneOptics optics;
    wfpsf::ScenePlan plan;
    size_t catalogue_size;
};

struct wfpsf_rendering {
    wfpsf::RenderReport report;
};

struct wfpsf_exposure {
    wfpsf::Exposure exposure;
    int sca_count;
};

struct wfpsf_study {
    wfpsf::Study study;
};

namespace wfpsf {

// The value of an option; the default if options is NULL.
double option(const wfpsf_options *options, int32_t key);
bool flag(const wfpsf_options *options, int32_t key);

// The extra Zernike coefficients; none if options is NULL.
const std::vector<double> &extra_zernikes(const wfpsf_options *options);

// Coefficients as a caller gives them, `count` at each of `points` places, once they are sound.
std::span<const double> checked_zernikes(int64_t count, const double *coefficients,
                                         int64_t points = 1);

// The optical path difference to add, or none.
std::shared_ptr<const OpdMap> opd_map(const wfpsf_options *options);
SceneReuse scene_reuse(const wfpsf_options *options);

// A caller's image of the pupil: its sampling must be sound, and its pixels are copied.
void check_pupil_sampling(const char *scale_name, double scale_m, double axis_x, double axis_y);
Plane<double> copy_of(const wfpsf_image &image);

// The caller's progress function and the limit of memory.
Manners manners_of(const wfpsf_options *options);

// The pupil that an SCA sees through a band, or the bare annulus: STRUTS.
std::unique_ptr<const Aperture> make_aperture_of(const Instrument &instrument, int32_t sca,
                                                 const char *band, const wfpsf_options *options);

PixelType pixel_type_of(int32_t pixel_type);

} // namespace wfpsf
