// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes: stars on a whole detector, drawn to an error budget. Errors are the largest in some
// windows against the exact engine, in units of what was allowed: a share of the local noise.
#include "unit/scene/scenes.hpp"

#include "harness.hpp"
#include "oracles/tilted_star.hpp"
#include "scene/render.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

namespace wfpsf::bench {

namespace {

constexpr double zero_flux = 5.3e12; // e- in 140 s of J129 from AB 0
constexpr double variance = 120;     // e-^2, of sky and read noise
constexpr int64_t detector_pixels = 4088;

class Truth {
  public:
    // What gives a pixel less than `little` electrons may be off.
    Truth(const SceneOptics &optics, double little)
        : optics_(optics), little_(little),
          far_(optics.middle(), optics.lights[0], probe_settings(optics.settings)) {}

    // All light that stars give a window. Those that give its pixels little, and very far ones, get
    // the far light of the detector's middle.
    Plane<double> window(std::span<const PlacedSource> stars, const SceneImage &window) const {
        constexpr double farthest = 400; // native pixels
        Plane<double> image(window.nx, window.ny);
        const double half = static_cast<double>(window.nx) / 2;
        for (const PlacedSource &star : stars) {
            const double x = star.x - window.x0, y = star.y - window.y0;
            const double off = std::max(std::abs(x - half), std::abs(y - half));
            const double nearest = std::max(off - half, far_.nearest());
            const bool is_far = off - half > far_.nearest();
            if (off > farthest || (is_far && star.flux * far_.brightest_beyond(nearest) < little_))
                add_far(star, x, y, image);
            else
                add_exact(star, x, y, off + half, image);
        }
        return image;
    }

  private:
    PsfSettings settings(double eps, double radius) const {
        PsfSettings settings = optics_.settings;
        settings.eps = eps;
        settings.radius = radius;
        return settings;
    }

    void add_far(const PlacedSource &star, double x, double y, Plane<double> &image) const {
        constexpr double floor = 1e-6; // e-
        far_.add({x, y, star.flux}, far_.nearest(), floor, image.view());
    }

    // A tilt of the wavefront brings the window of a star that is far off to where a small field
    // reaches.
    void add_exact(const PlacedSource &star, double x, double y, double reach,
                   Plane<double> &image) const {
        constexpr double near = 24, error = 1e-3; // native pixels, e-
        double dx = 0, dy = 0;
        if (reach > near) {
            dx = std::round(static_cast<double>(image.nx()) / 2 - x);
            dy = std::round(static_cast<double>(image.ny()) / 2 - y);
            reach = static_cast<double>(image.nx()) / 2 + 2;
        }
        const Instrument &roman = Instrument::get("roman-c9");
        const Region &region = optics_.region;
        const std::vector<double> waves = roman.zernikes(
            7, std::clamp(star.x, region.x0, region.x1), std::clamp(star.y, region.y0, region.y1));
        const Optics tilted = oracle::tilted(optics_.middle().aperture, waves, dx, dy);
        const double eps = std::clamp(error / (0.2 * star.flux), 1e-9, 1e-4);
        const Psf psf =
            std::move(make_psfs(tilted, {&optics_.lights[0], 1}, settings(eps, reach + 1))[0]);
        psf.draw({x + dx, y + dy, star.flux}, 1, image.view(), Psf::Drawing::adds);
    }

    const SceneOptics &optics_;
    double little_;
    FarLight far_;
};

// Where the first pixel of `light` is pixel (x0, y0) of the detector.
double largest_error_in(const Plane<double> &light, int64_t x0, int64_t y0,
                        const SceneBudget &budget, const Plane<float> &drawn) {
    double worst = 0;
    for (int64_t y = std::max<int64_t>(0, -y0); y < std::min(light.ny(), drawn.ny() - y0); ++y)
        for (int64_t x = std::max<int64_t>(0, -x0); x < std::min(light.nx(), drawn.nx() - x0);
             ++x) {
            const double error = std::abs(static_cast<double>(drawn(x0 + x, y0 + y)) - light(x, y));
            worst = std::max(worst, error / (budget.noise * std::sqrt(variance + light(x, y))));
        }
    return worst;
}

// Half the windows at random, half beside the brightest stars.
double largest_error(const SceneOptics &optics, std::vector<PlacedSource> stars,
                     const SceneBudget &budget, const Plane<float> &drawn) {
    constexpr int windows = 2;
    constexpr int64_t size = 16;
    const Truth truth(optics, 0.03 * budget.error());
    std::ranges::sort(stars, std::ranges::greater(), &PlacedSource::flux);
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> anywhere(0, detector_pixels - size), near(-60, 60);
    const auto inside = [](double at) {
        return std::round(std::clamp(at, 0.0, static_cast<double>(detector_pixels - size)));
    };
    double worst = 0;
    for (int w = 0; w < windows; ++w) {
        const PlacedSource &bright = stars[static_cast<size_t>(w)];
        const bool beside = w % 2 == 0;
        const SceneImage window{.x0 = inside(beside ? bright.x + near(random) : anywhere(random)),
                                .y0 = inside(beside ? bright.y + near(random) : anywhere(random)),
                                .nx = size,
                                .ny = size};
        worst = std::max(worst, largest_error_in(truth.window(stars, window),
                                                 static_cast<int64_t>(window.x0),
                                                 static_cast<int64_t>(window.y0), budget, drawn));
    }
    return worst;
}

// All about the brightest of some stars, with one exact PSF: what the others give there is far light.
double largest_error_about(const SceneOptics &optics, std::vector<PlacedSource> stars,
                           const SceneBudget &budget, const Plane<float> &drawn) {
    constexpr int64_t radius = 480, size = 2 * radius + 1; // native pixels
    std::ranges::sort(stars, std::ranges::greater(), &PlacedSource::flux);
    const PlacedSource &bright = stars[0];
    PsfSettings settings = optics.settings;
    settings.eps = 1e-9;
    settings.radius = radius + 1;
    const Psf psf = std::move(
        make_psfs(optics.nearest(bright.x, bright.y), {&optics.lights[0], 1}, settings)[0]);
    const int64_t x0 = std::lround(bright.x) - radius, y0 = std::lround(bright.y) - radius;
    const auto seen = [&](const PlacedSource &star) {
        return Star{star.x - static_cast<double>(x0), star.y - static_cast<double>(y0), star.flux};
    };
    Plane<double> light(size, size);
    psf.draw(seen(bright), 1, light.view());
    for (size_t k = 1; k < stars.size(); ++k) {
        constexpr double floor = 1e-5; // e-
        const FarLight far(optics.nearest(stars[k].x, stars[k].y), optics.lights[0],
                           probe_settings(optics.settings));
        far.add(seen(stars[k]), far.nearest(), floor, light.view());
    }
    return largest_error_in(light, x0, y0, budget, drawn);
}

struct Stars {
    int64_t count;
    double bright, faint; // AB magnitudes
    double slope = 0.4;   // of the counts, dex a magnitude
    int exposures = 1;    // of the same detector: one of the later ones is timed
    // In a process that begins with a store's file, which it takes time to read.
    bool from_file = false;

    std::vector<PlacedSource> on(const SceneImage &image, unsigned seed = 1) const {
        return scenes::stars({count, bright, faint, slope, zero_flux}, image, 32, 1, seed);
    }
    const char *kind() const {
        return from_file ? "from a file, " : exposures > 1 ? "a further exposure, " : "";
    }
};

// What is kept of an exposure with other stars.
std::shared_ptr<SceneStore> made_store(const SceneOptics &optics, const Stars &field,
                                       const SceneImage &image, const SceneBudget &budget) {
    constexpr unsigned another = 2;
    const SceneReuse reuse{std::make_shared<SceneStore>(), static_cast<double>(field.exposures)};
    Plane<float> drawn(image.nx, image.ny);
    render(optics, ScenePlan(optics, field.on(image, another), {}, budget, image, reuse),
           drawn.view(), 1);
    return reuse.store;
}

// Does work in a process of its own, so that this one's memory is as it was.
void elsewhere(const std::function<void()> &work) {
    const pid_t child = fork();
    if (child == 0) {
        work();
        _exit(0);
    }
    int status = 1;
    if (child < 0 || waitpid(child, &status, 0) != child || status != 0)
        std::abort();
}

Case stars_case(const Stars &field, double noise, double target_s, bool with_error) {
    char name[120];
    std::snprintf(name, sizeof name, "%s%.3g stars AB %g..%g%s on 4088^2, %g of the noise",
                  field.kind(), static_cast<double>(field.count), field.bright, field.faint,
                  field.slope < 0.1 ? " evenly" : "", noise);
    return {name, "largest error / error allowed", target_s, 1, [=] {
                const SceneOptics optics =
                    scenes::roman("J129", {detected_light(Instrument::get("roman-c9").band("J129"),
                                                          black_body_sed(5000))});
                const SceneImage image{.nx = detector_pixels, .ny = detector_pixels};
                std::vector<PlacedSource> stars = field.on(image);
                const SceneBudget budget{.noise = noise, .variance = variance};
                Plane<float> drawn(image.nx, image.ny);
                Measured m;
                m.error = NAN;
                std::vector<PlacedSource> kept;
                if (with_error)
                    kept = stars;
                SceneReuse reuse{{}, static_cast<double>(field.exposures)};
                const std::string file = std::filesystem::temp_directory_path() /
                                         ("wfpsf-bench-" + std::to_string(getpid()));
                if (field.from_file)
                    elsewhere([&] { made_store(optics, field, image, budget)->write(file); });
                else if (field.exposures > 1)
                    reuse.store = made_store(optics, field, image, budget);
                m.timing = time(
                    [&] {
                        if (field.from_file) {
                            reuse.store = std::make_shared<SceneStore>();
                            reuse.store->read(file);
                        }
                        for (int64_t y = 0; y < drawn.ny(); ++y) // may be drawn before
                            std::fill_n(drawn.view().row(y), drawn.nx(), 0.0F);
                        // Only what takes long enough to be drawn once need not be copied.
                        const bool once = field.count > 1000000;
                        const ScenePlan plan(optics, once ? std::move(stars) : stars, {}, budget,
                                             image, reuse);
                        m.baseline = "the time that was planned";
                        m.baseline_s = plan.time_s();
                        render(optics, plan, drawn.view(), 1);
                    },
                    1);
                std::filesystem::remove(file);
                constexpr size_t few = 10;
                if (with_error)
                    m.error = (kept.size() > few ? largest_error : largest_error_about)(
                        optics, std::move(kept), budget, drawn);
                return m;
            }};
}

} // namespace

// Time against budget, and against how bright the brightest stars are.
std::vector<Case> scene_cases() {
    std::vector<Case> cases;
    for (const double noise : {0.1, 0.03, 0.01, 0.003})
        cases.push_back(stars_case({100000, 24, 28}, noise, noise == 0.01 ? 5 : 0, noise == 0.01));
    for (const double noise : {0.1, 0.03, 0.01})
        cases.push_back(stars_case({100000, 20, 28}, noise, 0, false));
    for (const double noise : {0.1, 0.01})
        cases.push_back(stars_case({100000, 16, 28}, noise, 0, false));
    for (const double noise : {0.1, 0.03, 0.01})
        cases.push_back(stars_case({100000, 12, 28}, noise, noise == 0.01 ? 5 : 0, false));
    cases.push_back(stars_case({3, 12, 12.5}, 0.01, 0, true));
    for (const double bright : {24, 20, 16, 12})
        cases.push_back(
            stars_case({.count = 100000, .bright = bright, .faint = 28, .exposures = 50}, 0.01, 5,
                       bright == 24));
    const auto from_file = [&cases](int64_t count, double bright, double faint, double target_s,
                                    bool with_error) {
        const Stars field{
            .count = count, .bright = bright, .faint = faint, .exposures = 50, .from_file = true};
        cases.push_back(stars_case(field, 0.01, target_s, with_error));
    };
    from_file(100000, 20, 28, 5, false);
    from_file(100000, 12, 28, 5, false);
    from_file(3, 12, 12.5, 0, true);
    for (const double noise : {0.1, 0.01}) // a crowd
        cases.push_back(stars_case({100000, 20, 26, 0.001}, noise, 0, false));
    cases.push_back(stars_case({10000000, 26, 28}, 1, 0, false));
    return cases;
}

} // namespace wfpsf::bench
