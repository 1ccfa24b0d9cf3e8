// SPDX-License-Identifier: GPL-3.0-or-later
// A pupil given as geometry: areal quadrature and a nonuniform FFT.
#include "error/error.hpp"
#include "numerics/dispatch.hpp"
#include "numerics/nufft.hpp"
#include "numerics/phasor.hpp"
#include "optics/aperture.hpp"
#include "optics/pupil_nodes.hpp"
#include "optics/roman_region.hpp"
#include "optics/spider_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double rounding = 5e-14; // of A in units of the area: sums of 10^3 to 10^6 terms
constexpr double most_nodes = 1e6; // that a map's roughness may lead to, about
using Complex = std::complex<double>;

// exp(2 pi i factor turns) times a weight.
WFPSF_VECTORISED void waves(std::span<const double> turns, double factor, const double *weight,
                            double *re, double *im) {
    for (size_t n = 0; n < turns.size(); ++n) {
        double cosine, sine;
        phasor(factor * turns[n], cosine, sine);
        re[n] = weight[n] * cosine;
        im[n] = weight[n] * sine;
    }
}

// What a batch of nodes sends towards the focal plane: weight exp(2 pi i factor W), by factor.
struct Sources {
    std::vector<double> waves;
    struct Wave {
        std::vector<double> re, im;
    };
    std::vector<Wave> of;

    void take(const PupilNodes &nodes, const Wavefront &wavefront,
              std::span<const double> factors) {
        waves.resize(nodes.size());
        wavefront.evaluate(nodes.x, nodes.y, waves.data());
        of.resize(factors.size());
        for (size_t k = 0; k < factors.size(); ++k) {
            of[k].re.resize(nodes.size());
            of[k].im.resize(nodes.size());
            wfpsf::waves(waves, factors[k], nodes.weight.data(), of[k].re.data(), of[k].im.data());
        }
    }

    // The first of them times 2 pi i change.
    void differentiate(const PupilNodes &nodes, const Wavefront &change) {
        change.evaluate(nodes.x, nodes.y, waves.data());
        auto &[re, im] = of[0];
        for (size_t n = 0; n < nodes.size(); ++n) {
            const double phase = 2 * pi * waves[n];
            re[n] = -phase * std::exchange(im[n], phase * re[n]);
        }
    }
};

struct Quadrature {
    double wavenumber, eps; // of pupil_nodes()
};

// Where a pupil's sources stand for the transform to a grid.
struct Bands {
    double turn; // per metre of the pupil and step of the grid
    Type1Transform::Band x, y;
    int64_t modes; // K
    Bands(const Box &box, double wavelength, const FocalGrid &grid)
        : turn(2 * pi / wavelength * grid.step), x{turn * box.x0, turn * box.x1}, y{turn * box.y0,
                                                                                    turn * box.y1},
          modes((grid.size - 1) / 2) {}
};

// The amplitude on a grid, by a nonuniform FFT: made of the nodes once, then asked for its rows. For
// each factor by which the wavefront counts. Or its derivative, as a multiple of `change` is added
// to the wavefront.
class Transform {
  public:
    template <class Pupil>
    Transform(const Pupil &pupil, const Wavefront &wavefront, std::span<const double> factors,
              double wavelength, const FocalGrid &grid, const Quadrature &quadrature, double eps,
              const Wavefront *change = nullptr)
        : bands_(bounds(pupil), wavelength, grid),
          nufft_(bands_.x, bands_.y, bands_.modes, eps, factors.size()) {
        Sources sources;
        std::vector<double> a, b;
        std::vector<Complex> c;
        pupil_nodes(pupil, quadrature.wavenumber, quadrature.eps, [&](const PupilNodes &nodes) {
            sources.take(nodes, wavefront, factors);
            if (change)
                sources.differentiate(nodes, *change);
            a.resize(nodes.size());
            b.resize(nodes.size());
            c.clear();
            for (size_t n = 0; n < nodes.size(); ++n) {
                a[n] = bands_.turn * nodes.x[n];
                b[n] = bands_.turn * nodes.y[n];
            }
            for (const Sources::Wave &wave : sources.of)
                for (size_t n = 0; n < nodes.size(); ++n)
                    c.emplace_back(wave.re[n], wave.im[n]);
            nufft_.add(a, b, c);
            nodes_ += static_cast<int64_t>(nodes.size());
        });
    }

    int64_t nodes() const { return nodes_; }

    // |A|^2 in rows first..first+count-1 of the grid.
    Plane<double> intensity(int64_t first, int64_t count, size_t which = 0) const {
        Plane<double> out; // made after the transform's own memory, which serves the next one again
        const int64_t origin = first - bands_.modes;
        nufft_.rows(
            origin, origin + count - 1,
            [&](int64_t jy, std::span<const Complex> amplitude) {
                if (jy == origin)
                    out = Plane<double>::unset(2 * bands_.modes + 1, count);
                double *row = out.view().row(jy - origin);
                for (size_t x = 0; x < amplitude.size(); ++x)
                    row[x] = std::norm(amplitude[x]);
            },
            which);
        return out;
    }

    // All of it, the last time that this one is asked for.
    Plane<double> last_intensity(size_t which) {
        Plane<double> all = intensity(0, 2 * bands_.modes + 1, which);
        nufft_.release(which);
        return all;
    }

    // The amplitude itself, on all of the grid.
    Plane<Complex> amplitude() const {
        auto out = Plane<Complex>::unset(2 * bands_.modes + 1, 2 * bands_.modes + 1);
        nufft_.rows(-bands_.modes, bands_.modes,
                    [&](int64_t jy, std::span<const Complex> amplitude) {
                        std::ranges::copy(amplitude, out.view().row(jy + bands_.modes));
                    });
        return out;
    }

  private:
    Bands bands_;
    Type1Transform nufft_;
    int64_t nodes_ = 0;
};

class GeometricStrips final : public DiffractionStrips {
  public:
    GeometricStrips(Transform transform, double error) : transform_(std::move(transform)) {
        nodes_ = transform_.nodes();
        error_ = error;
    }
    Plane<double> rows(int64_t first, int64_t count) const override {
        return transform_.intensity(first, count);
    }

  private:
    Transform transform_;
};

// Grid indices on each axis at which an intensity is checked, all pairs of them: errors of the
// quadrature grow outwards, those of the transform are largest where there is most light.
constexpr size_t per_axis = 3;
constexpr double once[] = {1}; // the factor of one wavelength alone

std::array<int64_t, per_axis> probes(const FocalGrid &grid) {
    return {0, std::llround(grid.half()), std::llround(1.8 * grid.half())};
}

// The probes' sums, in lanes that become one vector.
constexpr size_t lanes = 8;
using Lanes = std::array<double, lanes>;
struct LaneSums {
    std::array<Lanes, per_axis * per_axis> re{}, im{}; // of probe y * per_axis + x
};

// Adds sources; the probes stand `turns` per metre of the pupil off the axis.
WFPSF_VECTORISED void add_to_probes(const PupilNodes &nodes, const Sources &sources,
                                    const std::array<double, per_axis> &turns,
                                    std::vector<LaneSums> &sums) {
    for (size_t first = 0; first < nodes.size(); first += lanes) {
        const size_t count = std::min(lanes, nodes.size() - first);
        Lanes x{}, y{};
        for (size_t l = 0; l < count; ++l) {
            x[l] = nodes.x[first + l];
            y[l] = nodes.y[first + l];
        }
        std::array<Lanes, per_axis> x_re, x_im, y_re, y_im;
        for (size_t i = 0; i < per_axis; ++i)
            for (size_t l = 0; l < lanes; ++l) {
                phasor(turns[i] * x[l], x_re[i][l], x_im[i][l]);
                phasor(turns[i] * y[l], y_re[i][l], y_im[i][l]);
            }
        for (size_t k = 0; k < sums.size(); ++k) {
            Lanes re{}, im{};
            for (size_t l = 0; l < count; ++l) {
                re[l] = sources.of[k].re[first + l];
                im[l] = sources.of[k].im[first + l];
            }
            for (size_t j = 0; j < per_axis; ++j) {
                Lanes here_re, here_im;
                for (size_t l = 0; l < lanes; ++l) {
                    here_re[l] = re[l] * y_re[j][l] - im[l] * y_im[j][l];
                    here_im[l] = re[l] * y_im[j][l] + im[l] * y_re[j][l];
                }
                for (size_t i = 0; i < per_axis; ++i) {
                    Lanes &sum_re = sums[k].re[j * per_axis + i];
                    Lanes &sum_im = sums[k].im[j * per_axis + i];
                    for (size_t l = 0; l < lanes; ++l) {
                        sum_re[l] += x_re[i][l] * here_re[l] - x_im[i][l] * here_im[l];
                        sum_im[l] += x_re[i][l] * here_im[l] + x_im[i][l] * here_re[l];
                    }
                }
            }
        }
    }
}

double largest(View<const double> intensity) {
    double most = 0;
    for (int64_t y = 0; y < intensity.ny; ++y)
        most = std::max(most, *std::max_element(intensity.row(y), intensity.row(y) + intensity.nx));
    return most;
}

template <class Pupil> class GeometricAperture final : public Aperture {
  public:
    GeometricAperture(const Pupil &pupil, std::vector<LitPart> parts, double diameter,
                      double fit_error)
        : pupil_(pupil), parts_(std::move(parts)), fit_error_(fit_error) {
        pupil_nodes(pupil, 20, 1e-15, [this](const PupilNodes &nodes) {
            area_ = std::accumulate(nodes.weight.begin(), nodes.weight.end(), area_);
        });
        diameter_ = diameter;
        outline_ = Outline::round;
    }

    Diffraction diffract(const Wavefront &wavefront, double wavelength, const FocalGrid &grid,
                         double eps) const override {
        return std::move(diffract_all(wavefront, wavelength, once, grid, eps, {})[0]);
    }

    // All by the same nodes, since a place on their grids is as many wavelengths off the axis.
    std::vector<Diffraction> diffract_all(const Wavefront &wavefront, double wavelength,
                                          std::span<const double> factors, const FocalGrid &grid,
                                          double eps, const Progress &progress) const override {
        std::vector<Diffraction> all(factors.size());
        double done = 0; // even if all are made again
        const Wavefront steepest = wavefront.scaled(std::ranges::max(factors));
        refine(steepest, wavelength, grid, eps,
               [&](const Quadrature &own, const Quadrature &finer, double asked) {
                   Transform transform(pupil_, wavefront, factors, wavelength, grid, own, asked);
                   for (size_t k = 0; k < all.size(); ++k) {
                       done =
                           std::max(done, static_cast<double>(k) / static_cast<double>(all.size()));
                       progress.report(done);
                       all[k].intensity = {};
                       all[k].intensity = transform.last_intensity(k);
                       all[k].nodes = transform.nodes();
                       all[k].model_error = fit_error_;
                   }
                   return find_errors(wavefront, wavelength, factors, grid, own, finer, all);
               });
        return all;
    }

    std::vector<Plane<double>> changes(const Wavefront &wavefront, std::span<const Wavefront> by,
                                       double wavelength, const FocalGrid &grid,
                                       double eps) const override {
        const Quadrature quadrature = refined(wavefront, wavelength, grid, eps).quadrature;
        const Plane<Complex> amplitude =
            Transform(pupil_, wavefront, once, wavelength, grid, quadrature, eps).amplitude();
        std::vector<Plane<double>> changes;
        for (const Wavefront &change : by) {
            const Plane<Complex> slope =
                Transform(pupil_, wavefront, once, wavelength, grid, quadrature, eps, &change)
                    .amplitude();
            auto &out = changes.emplace_back(Plane<double>::unset(grid.size, grid.size));
            for (int64_t y = 0; y < grid.size; ++y)
                for (int64_t x = 0; x < grid.size; ++x)
                    out(x, y) = 2 * (amplitude(x, y).real() * slope(x, y).real() +
                                     amplitude(x, y).imag() * slope(x, y).imag());
        }
        return changes;
    }

    // The transform is trusted by its own bound, since its rows are not at hand.
    std::unique_ptr<const DiffractionStrips> diffract_in_strips(const Wavefront &wavefront,
                                                                double wavelength,
                                                                const FocalGrid &grid,
                                                                double eps) const override {
        const double transform_eps = strip_share * eps;
        const auto [best, error] =
            refined(wavefront, wavelength, grid, (1 - 4 * strip_share) * eps);
        return std::make_unique<GeometricStrips>(
            Transform(pupil_, wavefront, once, wavelength, grid, best, transform_eps),
            error + 2 * std::max(transform_eps, nufft_best_eps));
    }

    StripMemory strip_memory(double wavelength, const FocalGrid &grid, double eps) const override {
        const Bands bands(bounds(pupil_), wavelength, grid);
        const auto [held, per_row] =
            Type1Transform::memory(bands.x, bands.y, bands.modes, strip_share * eps);
        return {held, per_row + grid.size * static_cast<int64_t>(sizeof(double))};
    }

    WavefrontPairs pairs(const Wavefront &wavefront) const override {
        PupilNodes all = pupil_nodes(pupil_, 40, 1e-3);
        std::vector<double> waves(all.size());
        wavefront.evaluate(all.x, all.y, waves.data());
        return {waves, all.weight};
    }

    PupilRaster raster(int64_t nx, int64_t ny) const override {
        return wfpsf::raster(parts_, nx, ny);
    }

    const std::vector<LitPart> &parts() const override { return parts_; }

  private:
    static constexpr double strip_share = 0.1; // of eps, for a strip's transform

    // Attempts with ever better quadratures, until the error that one returns meets eps, or no
    // attempt can.
    template <class Attempt>
    void refine(const Wavefront &wavefront, double wavelength, const FocalGrid &grid, double eps,
                const Attempt &attempt) const {
        // The fastest wave over the pupil: the grid's corner, plus the wavefront's own slope.
        const double of_grid = 2 * pi * std::numbers::sqrt2 * grid.largest_angle() / wavelength;
        double wavenumber = of_grid + 2 * pi * wavefront.slope_bound();
        // A map may be rougher than its slope tells: then the nodes grow denser, and where they
        // would be too many, the error is reported as it is.
        const bool rough = wavefront.has_map();
        const double densest = std::max(pi * std::sqrt(most_nodes / area_), 2 * of_grid);
        if (rough)
            wavenumber = std::min(wavenumber, densest);
        // Far from the core a wrong amplitude meets a small one, so that the intensity is better
        // than the amplitude; the transform's errors are those of many sources, of which most
        // cancel. So start loosely and let the check decide.
        constexpr double loosely = 8;
        double before = std::numeric_limits<double>::infinity();
        for (double asked = loosely * eps;;) {
            const Quadrature own{wavenumber, std::min(0.1, 30 * asked)};
            const Quadrature finer{(rough ? 1.3 : 1) * wavenumber, own.eps * 1e-2};
            const double error = attempt(own, finer, asked);
            const bool stuck = rough && error > before / 3;
            if (error <= eps || asked < 1e-18 || (stuck && wavenumber >= densest))
                return;
            if (stuck)
                wavenumber = std::min(1.5 * wavenumber, densest);
            else
                asked *= std::clamp(eps / error, 1e-3, 0.3);
            before = error;
        }
    }

    struct Refined {
        Quadrature quadrature;
        double error;
    };
    // A quadrature that meets eps at the probes, by plain sums.
    Refined refined(const Wavefront &wavefront, double wavelength, const FocalGrid &grid,
                    double eps) const {
        Refined best{};
        refine(wavefront, wavelength, grid, eps,
               [&](const Quadrature &own, const Quadrature &finer, double) {
                   best = {own, quadrature_error(wavefront, wavelength, grid, own, finer)};
                   return best.error;
               });
        return best;
    }

    // Four times the largest difference of |A|^2 at the probes between two quadratures.
    double quadrature_error(const Wavefront &wavefront, double wavelength, const FocalGrid &grid,
                            const Quadrature &own, const Quadrature &finer) const {
        const auto mine = at_probes(wavefront, wavelength, once, grid, own)[0];
        const auto truth = at_probes(wavefront, wavelength, once, grid, finer)[0];
        double worst = 0;
        for (size_t p = 0; p < truth.size(); ++p) {
            const double off = std::abs(mine[p] - truth[p]);
            worst = std::max(worst, wavefront.has_map()
                                        ? (2 * area_ + off) * off
                                        : std::abs(std::norm(mine[p]) - std::norm(truth[p])));
        }
        return 4 * worst / (area_ * area_) + rounding;
    }

    // The amplitude at the probes, by a plain sum, for each factor.
    using Amplitudes = std::array<Complex, per_axis * per_axis>;
    std::vector<Amplitudes> at_probes(const Wavefront &wavefront, double wavelength,
                                      std::span<const double> factors, const FocalGrid &grid,
                                      const Quadrature &quadrature) const {
        const std::array<int64_t, per_axis> at = probes(grid);
        std::array<double, per_axis> turns;
        for (size_t i = 0; i < per_axis; ++i)
            turns[i] = grid.angle(at[i]) / wavelength;
        std::vector<LaneSums> sums(factors.size());
        Sources sources;
        pupil_nodes(pupil_, quadrature.wavenumber, quadrature.eps, [&](const PupilNodes &nodes) {
            sources.take(nodes, wavefront, factors);
            add_to_probes(nodes, sources, turns, sums);
        });
        std::vector<Amplitudes> all;
        for (const LaneSums &sum : sums) {
            Amplitudes &amplitude = all.emplace_back();
            for (size_t p = 0; p < amplitude.size(); ++p)
                amplitude[p] = {std::accumulate(sum.re[p].begin(), sum.re[p].end(), 0.0),
                                std::accumulate(sum.im[p].begin(), sum.im[p].end(), 0.0)};
        }
        return all;
    }

    // Four times the largest difference of |A|^2 from a finer quadrature that is summed plainly.
    // What a map's roughness makes of the amplitude is the same at all angles, and counts where the
    // amplitude is largest. Returns the largest error of all.
    double find_errors(const Wavefront &wavefront, double wavelength,
                       std::span<const double> factors, const FocalGrid &grid,
                       const Quadrature &own, const Quadrature &finer,
                       std::vector<Diffraction> &all) const {
        const std::array<int64_t, per_axis> at = probes(grid);
        const bool rough = wavefront.has_map();
        const auto truth = at_probes(wavefront, wavelength, factors, grid, finer);
        const auto mine = rough ? at_probes(wavefront, wavelength, factors, grid, own)
                                : std::vector<Amplitudes>();
        double largest_error = 0;
        for (size_t k = 0; k < all.size(); ++k) {
            const View<const double> intensity = std::as_const(all[k].intensity).view();
            const double most = largest(intensity);
            double worst = 0, off = 0;
            for (size_t p = 0; p < truth[k].size(); ++p) {
                worst = std::max(worst, std::abs(intensity(at[p % per_axis], at[p / per_axis]) -
                                                 std::norm(truth[k][p])));
                if (rough)
                    off = std::max(off, std::abs(mine[k][p] - truth[k][p]));
            }
            worst = std::max(worst, (2 * std::sqrt(most) + off) * off);
            all[k].error = 4 * worst / (area_ * area_) + 2 * rounding * std::sqrt(most) / area_;
            largest_error = std::max(largest_error, all[k].error);
        }
        return largest_error;
    }

    Pupil pupil_;
    std::vector<LitPart> parts_;
    double fit_error_;
};

} // namespace

std::unique_ptr<const Aperture> make_aperture(const SegmentedPupil &pupil) {
    return std::make_unique<GeometricAperture<SegmentedPupil>>(
        pupil, lit_parts(pupil), 2 * pupil.outer.radius, pupil.fit_error);
}

std::unique_ptr<const Aperture> make_aperture(const RomanPupil &pupil) {
    const LitRegion region = lit_region(pupil);
    return std::make_unique<GeometricAperture<std::vector<Cell>>>(
        lit_cells(region), lit_parts(region), extent(pupil), pupil.fit_error);
}

std::unique_ptr<const Aperture> make_aperture(const SpiderPupil &pupil) {
    const double radius = pupil.outer_radius;
    if (pupil.struts.empty())
        return make_aperture(AnnularPupil{radius, pupil.inner_radius});
    const LitRegion region = lit_region(pupil);
    auto aperture = std::make_unique<GeometricAperture<std::vector<Cell>>>(
        lit_cells(region), lit_parts(region), 2 * radius, 0.0);
    if (!(aperture->area() > 1e-6 * pi * radius * radius))
        fail(WFPSF_ERROR_ARGUMENT, "struts: leave %g m^2 of the pupil lit", aperture->area());
    return aperture;
}

std::unique_ptr<const Aperture> make_aperture(const AnnularPupil &pupil) {
    return std::make_unique<GeometricAperture<AnnularPupil>>(pupil, lit_parts(pupil),
                                                             2 * pupil.outer_radius, 0.0);
}

} // namespace wfpsf
