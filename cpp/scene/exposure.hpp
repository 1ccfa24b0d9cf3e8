// SPDX-License-Identifier: GPL-3.0-or-later
// An exposure of a focal plane: every detector's image in a FITS file of its own, so that work that
// was broken off goes on where it stopped.
#pragma once

#include "detector/chain.hpp"
#include "error/progress.hpp"
#include "scene/catalogue.hpp"
#include "scene/plan.hpp"

#include <functional>
#include <string>

namespace wfpsf {

struct ExposureSettings {
    std::string instrument, band;
    double pixel_scale_arcsec;
    PixelCounts pixels;   // of a detector
    double exposure_time; // s
    double zero_flux;     // e- from AB magnitude 0
    double background;    // mean, e- a pixel
    SceneBudget budget;
    SceneReuse reuse;
    uint64_t seed;
    uint32_t number; // of the exposure: another one has other noise
    bool with_noise;
};

// Immutable.
class Exposure {
  public:
    // Every detector of an exposure has a stream of random numbers of its own.
    static constexpr uint32_t most_detectors = 64;
    static constexpr uint32_t largest_number = 0xffffffff / most_detectors - 1;

    // Without `chain` files hold the electrons that light brings, sources and background.
    Exposure(const Observation &observation, Catalogue catalogue, ExposureSettings settings,
             std::function<SceneOptics(int sca)> optics, std::optional<Chain> chain);

    // exposure_00001_sca07.fits
    std::string path(const std::string &folder, int sca) const;

    // Makes a detector's file, which appears whole or not at all. False: it is there already, made
    // of the same; made of other things, WFPSF_ERROR_FILE_WRITE unless it may be replaced.
    bool make(const std::string &folder, int sca, bool overwrite, int threads,
              const Manners &manners) const;

  private:
    std::string fingerprint(int sca, const SceneOptics &optics) const;

    Observation observation_;
    Catalogue catalogue_;
    ExposureSettings settings_;
    std::function<SceneOptics(int sca)> optics_;
    std::optional<Chain> chain_;
    uint64_t common_; // fingerprint of what all detectors share
};

} // namespace wfpsf
