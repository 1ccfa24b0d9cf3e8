// SPDX-License-Identifier: GPL-3.0-or-later
// A pupil given as geometry: areal quadrature and a nonuniform FFT.
#include "error/error.hpp"
#include "numerics/nufft.hpp"
#include "optics/aperture.hpp"
#include "optics/pupil_nodes.hpp"
#include "optics/roman_region.hpp"
#include "optics/spider_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-13; // of |A|^2 in units of area^2: sums of 10^3 to 10^5 terms
constexpr double most_nodes = 1e6; // that a map's roughness may lead to, about
using Complex = std::complex<double>;

// What the nodes send towards the focal plane: weight exp(2 pi i W).
std::vector<Complex> sources(const PupilNodes &nodes, const Wavefront &wavefront) {
    std::vector<Complex> field(nodes.size());
    for (size_t n = 0; n < nodes.size(); ++n)
        field[n] = nodes.weight[n] * std::polar(1.0, 2 * pi * wavefront(nodes.x[n], nodes.y[n]));
    return field;
}

// The amplitude on the whole grid, by a nonuniform FFT.
Plane<Complex> transform(const PupilNodes &nodes, const Wavefront &wavefront, double wavelength,
                         const FocalGrid &grid, double eps) {
    const double turn = 2 * pi / wavelength * grid.step;
    std::vector<double> a(nodes.size()), b(nodes.size());
    for (size_t n = 0; n < nodes.size(); ++n) {
        a[n] = turn * nodes.x[n];
        b[n] = turn * nodes.y[n];
    }
    Plane<Complex> out(grid.size, grid.size);
    nufft_type1(a, b, sources(nodes, wavefront), (grid.size - 1) / 2, eps, out.view().data);
    return out;
}

// Grid indices on each axis at which an amplitude is checked, all pairs of them: errors grow
// outwards, so mostly near the border.
constexpr size_t per_axis = 2;
using Probes = std::array<Complex, per_axis * per_axis>; // y * per_axis + x

std::array<int64_t, per_axis> probes(const FocalGrid &grid) {
    return {0, std::llround(1.8 * grid.half())};
}

// The amplitude at the probes by plain summation.
Probes sum_at_probes(const PupilNodes &nodes, const Wavefront &wavefront, double wavelength,
                     const FocalGrid &grid) {
    const double k = 2 * pi / wavelength;
    const std::array<int64_t, per_axis> at = probes(grid);
    const std::vector<Complex> field = sources(nodes, wavefront);
    Probes sums{};
    for (size_t n = 0; n < nodes.size(); ++n) {
        std::array<Complex, per_axis> along_x, along_y;
        for (size_t j = 0; j < per_axis; ++j) {
            along_x[j] = std::polar(1.0, k * nodes.x[n] * grid.angle(at[j]));
            along_y[j] = field[n] * std::polar(1.0, k * nodes.y[n] * grid.angle(at[j]));
        }
        for (size_t j = 0; j < sums.size(); ++j)
            sums[j] += along_x[j % per_axis] * along_y[j / per_axis];
    }
    return sums;
}

double largest(const Plane<Complex> &amplitude) {
    double norm = 0;
    for (int64_t y = 0; y < amplitude.ny(); ++y)
        for (int64_t x = 0; x < amplitude.nx(); ++x)
            norm = std::max(norm, std::norm(amplitude(x, y)));
    return std::sqrt(norm);
}

template <class Pupil> class GeometricAperture final : public Aperture {
  public:
    GeometricAperture(const Pupil &pupil, double diameter, double fit_error)
        : pupil_(pupil), fit_error_(fit_error) {
        const PupilNodes nodes = pupil_nodes(pupil, 1, 1e-15);
        for (const double weight : nodes.weight)
            area_ += weight;
        diameter_ = diameter;
    }

    Amplitude amplitude(const Wavefront &wavefront, double wavelength, const FocalGrid &grid,
                        double eps) const override {
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
        // than the amplitude: start loosely and let the check decide.
        double before = std::numeric_limits<double>::infinity();
        for (double asked = std::min(0.1, 30 * eps);;) {
            const PupilNodes nodes = pupil_nodes(pupil_, wavenumber, asked);
            Plane<Complex> value = transform(nodes, wavefront, wavelength, grid, eps / 4);
            const double error =
                check(value, pupil_nodes(pupil_, (rough ? 1.3 : 1) * wavenumber, asked * 1e-2),
                      wavefront, wavelength, grid);
            const bool stuck = rough && error > before / 3;
            if (error <= eps || asked < 1e-17 || (stuck && wavenumber >= densest))
                return {std::move(value), static_cast<int64_t>(nodes.size()), error, fit_error_};
            if (stuck)
                wavenumber = std::min(1.5 * wavenumber, densest);
            else
                asked *= std::clamp(eps / error, 1e-3, 0.3);
            before = error;
        }
    }

  private:
    // Four times the largest difference of |A|^2 from a finer quadrature that is summed plainly.
    // What a map's roughness makes of the amplitude is the same at all angles, and counts where the
    // amplitude is largest.
    double check(const Plane<Complex> &value, const PupilNodes &finer, const Wavefront &wavefront,
                 double wavelength, const FocalGrid &grid) const {
        const std::array<int64_t, per_axis> at = probes(grid);
        const Probes truth = sum_at_probes(finer, wavefront, wavelength, grid);
        double worst = 0, off = 0; // |A|^2, A
        for (size_t j = 0; j < truth.size(); ++j) {
            const Complex here = value(at[j % per_axis], at[j / per_axis]);
            worst = std::max(worst, std::abs(std::norm(here) - std::norm(truth[j])));
            off = std::max(off, std::abs(here - truth[j]));
        }
        if (wavefront.has_map())
            worst = (2 * largest(value) + off) * off;
        return 4 * worst / (area_ * area_) + rounding;
    }

    Pupil pupil_;
    double fit_error_;
};

} // namespace

std::unique_ptr<const Aperture> make_aperture(const SegmentedPupil &pupil) {
    return std::make_unique<GeometricAperture<SegmentedPupil>>(pupil, 2 * pupil.outer.radius,
                                                               pupil.fit_error);
}

std::unique_ptr<const Aperture> make_aperture(const RomanPupil &pupil) {
    return std::make_unique<GeometricAperture<std::vector<Cell>>>(lit_cells(lit_region(pupil)),
                                                                  extent(pupil), pupil.fit_error);
}

std::unique_ptr<const Aperture> make_aperture(const SpiderPupil &pupil) {
    const double radius = pupil.outer_radius;
    if (pupil.struts.empty())
        return make_aperture(AnnularPupil{radius, pupil.inner_radius});
    auto aperture = std::make_unique<GeometricAperture<std::vector<Cell>>>(
        lit_cells(lit_region(pupil)), 2 * radius, 0.0);
    if (!(aperture->area() > 1e-6 * pi * radius * radius))
        fail(WFPSF_ERROR_ARGUMENT, "struts: leave %g m^2 of the pupil lit", aperture->area());
    return aperture;
}

std::unique_ptr<const Aperture> make_aperture(const AnnularPupil &pupil) {
    return std::make_unique<GeometricAperture<AnnularPupil>>(pupil, 2 * pupil.outer_radius, 0.0);
}

} // namespace wfpsf
