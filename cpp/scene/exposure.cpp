// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/exposure.hpp"

#include "error/error.hpp"
#include "image/archive.hpp"
#include "image/fits.hpp"
#include "scene/fingerprint.hpp"
#include "scene/render.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <span>

namespace wfpsf {

namespace {

constexpr const char *key_name = "SCENEKEY";

void add(Fingerprint &print, const VaryingIpc &ipc) {
    for (const auto &[dx, dy] : ipc.offsets()) {
        print.add(dx);
        print.add(dy);
    }
    Plane<double> taps(ipc.nx(), std::ssize(ipc.offsets()));
    ByteSum sum; // quicker, and there are many
    for (int64_t y = 0; y < ipc.ny(); ++y) {
        ipc.taps(y, taps.view());
        for (int64_t k = 0; k < taps.ny(); ++k)
            sum.add(std::as_bytes(std::span(taps.view().row(k), static_cast<size_t>(taps.nx()))));
    }
    print.add(sum.value());
}

void add(Fingerprint &print, const Chain &chain) {
    for (const Step &step : chain.steps()) {
        print.add(static_cast<int32_t>(step.kind));
        for (const double parameter : step.parameters)
            print.add(parameter);
        if (step.kernel) {
            const View<const double> taps = step.kernel->table();
            for (int64_t y = 0; y < taps.ny; ++y)
                for (int64_t x = 0; x < taps.nx; ++x)
                    print.add(taps(x, y));
        }
        print.add(static_cast<int32_t>(step.form));
        print.add(static_cast<int32_t>(step.edge));
        if (step.varying)
            add(print, *step.varying);
        for (int64_t y = 0; y < step.map.ny(); ++y)
            for (int64_t x = 0; x < step.map.nx(); ++x)
                print.add(static_cast<double>(step.map(x, y)));
    }
}

void add(Fingerprint &print, const SceneOptics &optics) {
    const PsfSettings &s = optics.settings;
    for (const double value :
         {s.wavelength, s.pixel_scale, s.blur.xx, s.blur.xy, s.blur.yy, s.mirrored ? 1.0 : 0.0})
        print.add(value);
    for (const Light &light : optics.lights) {
        const Spectrum spectrum = light(0);
        for (size_t i = 0; i < spectrum.size(); ++i) {
            print.add(spectrum.wavelength[i]);
            print.add(spectrum.weight[i]);
        }
    }
    // The wavefront at some places of the detector and of the pupil.
    for (const auto &[x, y] :
         {std::pair(0.0, 0.0), std::pair(4000.0, 100.0), std::pair(50.0, 4000.0)}) {
        const Optics here = optics.at(x, y);
        const double r = here.aperture->diameter() / 2;
        print.add(here.aperture->area());
        for (const auto &[u, v] : {std::pair(0.1, 0.9), std::pair(-0.7, 0.3), std::pair(0.5, -0.5)})
            print.add(here.wavefront(u * r, v * r));
    }
}

} // namespace

Exposure::Exposure(const Observation &observation, Catalogue catalogue, ExposureSettings settings,
                   std::function<SceneOptics(int sca)> optics, std::optional<Chain> chain)
    : observation_(observation), catalogue_(std::move(catalogue)), settings_(std::move(settings)),
      optics_(std::move(optics)), chain_(std::move(chain)) {
    Fingerprint print;
    print.add(settings_.instrument);
    print.add(settings_.band);
    for (const double value :
         {settings_.exposure_time, settings_.zero_flux, settings_.background,
          settings_.budget.noise, settings_.budget.variance, settings_.budget.flux,
          settings_.with_noise ? 1.0 : 0.0, chain_ ? 1.0 : 0.0})
        print.add(value);
    print.add(settings_.seed);
    print.add(int64_t{settings_.number});
    if (chain_)
        add(print, *chain_);
    catalogue_.add_to(print);
    common_ = print.value();
}

std::string Exposure::path(const std::string &folder, int sca) const {
    char name[64];
    std::snprintf(name, sizeof name, "exposure_%05u_sca%02d.fits", settings_.number, sca);
    return (std::filesystem::path(folder) / name).string();
}

std::string Exposure::fingerprint(int sca, const SceneOptics &optics) const {
    Fingerprint print;
    print.add(common_);
    print.add(fits_header(observation_, sca));
    add(print, optics);
    char text[32];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(print.value()));
    return text;
}

bool Exposure::make(const std::string &folder, int sca, bool overwrite, int threads,
                    const Manners &manners) const {
    const SceneOptics optics = optics_(sca);
    const std::string file = path(folder, sca), key = fingerprint(sca, optics);
    if (std::filesystem::exists(file)) {
        if (read_fits_text(file, key_name) == key)
            return false;
        if (!overwrite)
            fail(WFPSF_ERROR_FILE_WRITE, "%s: is there, and was made of other things",
                 file.c_str());
    }
    Image image(PixelType::float32, settings_.pixels.x, settings_.pixels.y);
    const ScenePlan plan(optics, catalogue_.placed(&observation_, sca, settings_.zero_flux),
                         catalogue_.shapes(), settings_.budget,
                         {0, 0, settings_.pixels.x, settings_.pixels.y, 1}, settings_.reuse,
                         threads);
    const View<float> pixels = std::get<View<float>>(image.pixels());
    const Manners drawing{manners.progress.between(0, 0.9), manners.memory_limit};
    const RenderReport report = render(optics, plan, pixels, threads, drawing);
    image.set_pixel_scale_arcsec(settings_.pixel_scale_arcsec);
    image.record_applied(Effect::pixel_response);
    for (int64_t y = 0; y < pixels.ny; ++y)
        for (int64_t x = 0; x < pixels.nx; ++x)
            pixels(x, y) += static_cast<float>(settings_.background);
    image.record_applied(Effect::background);
    if (chain_)
        chain_->run(
            {.random = {.seed = settings_.seed,
                        .stream = settings_.number * most_detectors + static_cast<uint32_t>(sca)},
             .with_noise = settings_.with_noise,
             .threads = threads},
            image);
    manners.progress.report(0.95);
    std::vector<FitsKeyword> keywords = fits_keywords(observation_, sca);
    const std::vector<FitsKeyword> record = {
        {"INSTRUME", settings_.instrument, "figures of this telescope"},
        {"FILTER", settings_.band, "band"},
        {"EXPTIME", settings_.exposure_time, "[s]"},
        {"EXPNUM", int64_t{settings_.number}, "number of the exposure, stream of its noise"},
        {"SEED", static_cast<int64_t>(settings_.seed), "of random numbers"},
        {"SKYLEVEL", settings_.background, "[e-] mean background of a pixel"},
        {"NSOURCES", static_cast<int64_t>(plan.sources().size()), "sources considered"},
        {"NDRAWN", report.drawn, "sources whose stamps reach the image"},
        {"ERRALLOW", settings_.budget.error(), "[e-] error of a pixel that was allowed"},
        {"ERRESTIM", report.error, "[e-] estimate of the largest one"},
        {key_name, key, "of all that this was made of"}};
    keywords.insert(keywords.end(), record.begin(), record.end());
    write_fits(file, image, overwrite, keywords);
    return true;
}

} // namespace wfpsf
