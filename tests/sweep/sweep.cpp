// SPDX-License-Identifier: GPL-3.0-or-later
// Holds the accuracy contract of PSFs: at every eps, the error of every probed pixel, in units of
// the stamp's peak pixel, is at most the reported estimate; and at most eps, unless the estimate
// says that it may be more. The truth is a sum along the pupil's outline, or over points of its
// area that follow from the outline, and shares nothing with the engine.
//
//     sweep          part of the grid, about a minute
//     sweep --all    all of it
#include "error/error.hpp"
#include "instrument/instrument.hpp"
#include "optics/psf.hpp"
#include "oracles/outline.hpp"
#include "oracles/zernike_oracle.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace wfpsf {
namespace {

using namespace oracle;

constexpr double pixel_scale = 0.11 * std::numbers::pi / 180 / 3600;

struct Case {
    std::string name, group;
    std::shared_ptr<const Aperture> aperture;
    oracle::Outline outline;
    std::vector<double> zernikes; // waves at `wavelength`
    double wavelength;
    bool mirrored;
};

// Pupils and their outlines are made once.
struct Shape {
    std::shared_ptr<const Aperture> aperture;
    oracle::Outline outline;
};
const Shape &shape_of(const std::string &name, const Pupil &pupil) {
    static std::map<std::string, Shape> known;
    const auto at = known.find(name);
    if (at != known.end())
        return at->second;
    return known
        .emplace(name, std::visit(
                           [](const auto &p) {
                               return Shape{make_aperture(p), oracle::outline(p)};
                           },
                           pupil))
        .first->second;
}

std::vector<double> aberrations(const Instrument &instrument, int sca, double x, double y,
                                double wavelength) {
    std::vector<double> waves = instrument.zernikes(sca, x, y);
    std::fill_n(waves.begin(), 3, 0.0);
    for (double &a : waves)
        a *= instrument.reference_wavelength_nm() * 1e-9 / wavelength;
    return waves;
}

void add_c5(std::vector<Case> &cases) {
    const Instrument &c5 = Instrument::get("wfirst-afta-c5");
    const AnnularPupil annulus = c5.annular_pupil();
    const Pupil bare = SpiderPupil{annulus.outer_radius, annulus.inner_radius, {}};
    for (const Band &band : c5.bands)
        for (const int sca : {1, 4, 7, 13, 18})
            for (const bool struts : {true, false}) {
                const double wavelength = tabulated_wavelengths(band).effective_nm * 1e-9;
                const Shape &shape =
                    struts ? shape_of("c5", c5.pupil(sca, band.name)) : shape_of("c5 bare", bare);
                const std::vector<double> zernikes = aberrations(c5, sca, 2044, 2044, wavelength);
                const std::string name = std::string("C5 ") + band.name + " SCA " +
                                         std::to_string(sca) + (struts ? "" : " no struts");
                cases.push_back({name, struts ? "C5" : "C5, no struts", shape.aperture,
                                 shape.outline, zernikes, wavelength, false});
            }
}

void add_roman(std::vector<Case> &cases) {
    const Instrument &roman = Instrument::get("roman-c9");
    // Centre, corners, and as far beyond the edge as aberrations are given.
    constexpr double last = 4087, margin = Instrument::field_margin_pix;
    const struct {
        const char *name;
        double x, y;
    } places[] = {{"centre", 2043.5, 2043.5},
                  {"corner", 0, 0},
                  {"far corner", last, last},
                  {"beyond", -margin, last + margin}};
    for (const Band &band : roman.bands)
        for (const int sca : {1, 7, 16, 18})
            for (const auto &place : places) {
                const double wavelength = tabulated_wavelengths(band).effective_nm * 1e-9;
                const bool is_long =
                    std::strcmp(band.name, "F184") == 0 || std::strcmp(band.name, "K213") == 0;
                const Shape &shape = shape_of((is_long ? "long " : "short ") + std::to_string(sca),
                                              roman.pupil(sca, band.name));
                cases.push_back({std::string("Roman ") + band.name + " SCA " + std::to_string(sca) +
                                     ' ' + place.name,
                                 "Roman", shape.aperture, shape.outline,
                                 aberrations(roman, sca, place.x, place.y, wavelength), wavelength,
                                 true});
            }
}

// Without aberrations the truth is cheap at any distance.
std::vector<Case> flat(const std::vector<Case> &cases) {
    std::vector<Case> out = cases;
    for (Case &c : out) {
        c.name += " unaberrated";
        c.zernikes.clear();
    }
    return out;
}

struct Pixel {
    int64_t x, y;
};

// The core, some rings, edges, corners, and others.
std::vector<Pixel> probes(int64_t size, std::mt19937 &random) {
    const int64_t middle = size / 2, last = size - 1;
    std::vector<Pixel> at{
        {middle, middle}, {middle - 1, middle}, {middle, middle - 1}, {middle + 1, middle},
        {0, 0},           {last, last},         {0, middle},          {middle, last}};
    std::uniform_real_distribution<double> turn(0, 2 * std::numbers::pi);
    for (double radius = 2; radius < static_cast<double>(middle); radius *= 2.7) {
        const double a = turn(random);
        at.push_back({middle + std::llround(radius * std::cos(a)),
                      middle + std::llround(radius * std::sin(a))});
    }
    std::uniform_int_distribution<int64_t> any(0, last);
    for (int i = 0; i < 2; ++i)
        at.push_back({any(random), any(random)});
    return at;
}

double peak_of(const Plane<double> &stamp) {
    double peak = 0;
    for (int64_t y = 0; y < stamp.ny(); ++y)
        for (int64_t x = 0; x < stamp.nx(); ++x)
            peak = std::max(peak, stamp(x, y));
    return peak;
}

struct Worst {
    double over_eps = 0, over_estimate = 0;
    int stamps = 0, uncertified = 0;
    std::string where;
};

class Sweep {
  public:
    void run(const Case &c, int64_t size, const std::vector<double> &tolerances) {
        std::uniform_real_distribution<double> offset(-0.5, 0.5);
        std::uniform_int_distribution<int64_t> finer(1, size <= 65 ? 4 : 1);
        const int64_t oversampling = finer(random_);
        const auto n = static_cast<double>(oversampling), middle = static_cast<double>(size / 2);
        const double star_x = middle + offset(random_), star_y = middle + offset(random_);
        const std::vector<Pixel> at = probes(size, random_);
        std::vector<Vec> angles;
        for (const Pixel &p : at)
            angles.push_back(
                {(static_cast<double>(p.x) - star_x) / n * pixel_scale,
                 (static_cast<double>(p.y) - star_y) / n * pixel_scale * (c.mirrored ? -1 : 1)});
        const ZernikeWaves waves(c.zernikes, 1.18);
        const std::vector<double> truth =
            c.zernikes.empty() ? contour_pixels(c.outline, c.wavelength, pixel_scale, angles)
                               : green_pixels(c.outline, waves, waves.largest_slope(), c.wavelength,
                                              pixel_scale, angles);
        const auto draw = [&](double eps, Plane<double> &stamp) {
            const Psf psf(c.aperture, Wavefront(c.zernikes, 1.18),
                          {.wavelength = c.wavelength,
                           .pixel_scale = pixel_scale,
                           .eps = eps,
                           .radius = static_cast<double>(size) / 2 / n + 1,
                           .mirrored = c.mirrored});
            psf.draw({star_x, star_y, n * n}, oversampling, stamp.view());
            return psf.error_estimate();
        };
        const auto error_at_probes = [&](const Plane<double> &stamp) {
            double error = 0;
            for (size_t p = 0; p < at.size(); ++p)
                error = std::max(error, std::abs(stamp(at[p].x, at[p].y) - truth[p]));
            return error;
        };
        // The best that the engine can do stands in for the truth in all other pixels.
        const bool every_pixel = size <= 128;
        Plane<double> best(size, size), stamp(size, size);
        if (every_pixel) {
            const double estimate = draw(1e-12, best);
            note(c, size, 1e-12, error_at_probes(best) / peak_of(best), estimate);
        }
        for (const double eps : tolerances) {
            const double estimate = draw(eps, stamp);
            double error = error_at_probes(stamp);
            for (int64_t y = 0; y < size && every_pixel; ++y)
                for (int64_t x = 0; x < size; ++x)
                    error = std::max(error, std::abs(stamp(x, y) - best(x, y)));
            note(c, size, eps, error / peak_of(stamp), estimate);
        }
    }

    // Whether the contract held.
    bool report() const {
        std::printf("%-16s %5s %7s %11s %15s %12s  %s\n", "pupils", "eps", "stamps", "error/eps",
                    "error/estimate", "uncertified", "worst");
        for (const auto &[key, w] : worst_)
            std::printf("%-16s 1e-%02d %7d %11.4f %15.4f %12d  %s\n", key.second.c_str(), key.first,
                        w.stamps, w.over_eps, w.over_estimate, w.uncertified, w.where.c_str());
        std::printf("%d violations of the contract\n", violations_);
        return violations_ == 0;
    }

  private:
    void note(const Case &c, int64_t size, double eps, double error, double estimate) {
        const bool certified = estimate <= eps;
        for (const std::string &group : {c.group, std::string("all")}) {
            Worst &w = worst_[{static_cast<int>(std::lround(-std::log10(eps))), group}];
            ++w.stamps;
            w.uncertified += !certified;
            if (error / eps > w.over_eps)
                w.where = c.name + ", " + std::to_string(size);
            w.over_eps = std::max(w.over_eps, error / eps);
            w.over_estimate = std::max(w.over_estimate, error / estimate);
        }
        if (error > estimate || (certified && error > eps) || !std::isfinite(error)) {
            ++violations_;
            std::printf("VIOLATION: %s, %lld pixels, eps %g: error %g, estimate %g\n",
                        c.name.c_str(), static_cast<long long>(size), eps, error, estimate);
        }
    }

    std::mt19937 random_{1};
    std::map<std::pair<int, std::string>, Worst> worst_; // by digits of eps
    int violations_ = 0;
};

std::vector<double> powers(double first, double last) {
    std::vector<double> all;
    for (double eps = first; eps > last / 2; eps /= 10)
        all.push_back(eps);
    return all;
}

// Every `stride`-th case.
std::vector<Case> some(const std::vector<Case> &cases, size_t first, size_t stride) {
    std::vector<Case> out;
    for (size_t i = first; i < cases.size(); i += stride)
        out.push_back(cases[i]);
    return out;
}

int run(bool all) {
    const auto start = std::chrono::steady_clock::now();
    std::vector<Case> cases;
    add_c5(cases);
    add_roman(cases);
    const std::vector<Case> plain = flat(cases);
    const auto every = powers(1e-2, 1e-10);
    const auto stride = [all](size_t n) { return all ? 1 : n; };
    Sweep sweep;
    const auto cover = [&](const std::vector<Case> &which, int64_t size,
                           const std::vector<double> &eps) {
        for (const Case &c : which)
            sweep.run(c, size, eps);
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        std::printf("%zu cases of %lld pixels, done after %.1f s\n", which.size(),
                    static_cast<long long>(size), seconds.count());
        std::fflush(stdout);
    };
    cover(some(cases, 0, stride(3)), 8, every);
    cover(some(cases, 1, stride(5)), 33, every);
    cover(some(cases, 2, stride(31)), 64, every);
    cover(some(cases, 2, all ? 5 : 61), 128, every);
    cover(some(plain, 0, stride(7)), 16, every);
    cover(some(plain, 3, stride(13)), 65, every);
    cover(some(plain, 4, all ? 9 : 61), 256, {1e-3, 1e-6, 1e-9});
    cover(some(plain, 5, all ? 23 : 187), 512, {1e-2, 1e-5, 1e-10});
    if (all)
        cover(some(cases, 5, 93), 512, {1e-2, 1e-6, 1e-10});
    return sweep.report() ? 0 : 1;
}

} // namespace
} // namespace wfpsf

int main(int argc, char **argv) {
    try {
        return wfpsf::run(argc > 1 && std::strcmp(argv[1], "--all") == 0);
    } catch (const std::exception &e) {
        std::printf("%s\n", e.what());
        return 1;
    }
}
