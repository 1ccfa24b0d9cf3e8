// SPDX-License-Identifier: GPL-3.0-or-later
// A pupil given as geometry: areal quadrature and a nonuniform FFT.
#include "numerics/nufft.hpp"
#include "optics/aperture.hpp"
#include "optics/pupil_nodes.hpp"
#include "optics/roman_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-13; // of |A|^2 in units of area^2: sums of 10^3 to 10^5 terms
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

template <class Pupil> class GeometricAperture final : public Aperture {
  public:
    GeometricAperture(const Pupil &pupil, std::vector<LitPart> parts, double diameter,
                      double fit_error)
        : pupil_(pupil), parts_(std::move(parts)), fit_error_(fit_error) {
        const PupilNodes nodes = pupil_nodes(pupil, 1, 1e-15);
        for (const double weight : nodes.weight)
            area_ += weight;
        diameter_ = diameter;
    }

    Amplitude amplitude(const Wavefront &wavefront, double wavelength, const FocalGrid &grid,
                        double eps) const override {
        // The fastest wave over the pupil: the grid's corner, plus the wavefront's own slope.
        const double wavenumber =
            2 * pi *
            (std::numbers::sqrt2 * grid.largest_angle() / wavelength + wavefront.slope_bound());
        // Far from the core a wrong amplitude meets a small one, so that the intensity is better
        // than the amplitude: start loosely and let the check decide.
        for (double asked = std::min(0.1, 30 * eps);;) {
            const PupilNodes nodes = pupil_nodes(pupil_, wavenumber, asked);
            Plane<Complex> value = transform(nodes, wavefront, wavelength, grid, eps / 4);
            const double error = check(value, pupil_nodes(pupil_, wavenumber, asked * 1e-2),
                                       wavefront, wavelength, grid);
            if (error <= eps || asked < 1e-17)
                return {std::move(value), static_cast<int64_t>(nodes.size()), error, fit_error_};
            asked *= std::clamp(eps / error, 1e-3, 0.3);
        }
    }

    PupilRaster raster(int64_t nx, int64_t ny) const override {
        return wfpsf::raster(parts_, nx, ny);
    }

  private:
    // Four times the largest difference of |A|^2 from a finer quadrature that is summed plainly.
    double check(const Plane<Complex> &value, const PupilNodes &finer, const Wavefront &wavefront,
                 double wavelength, const FocalGrid &grid) const {
        const std::array<int64_t, per_axis> at = probes(grid);
        const Probes truth = sum_at_probes(finer, wavefront, wavelength, grid);
        double worst = 0;
        for (size_t j = 0; j < truth.size(); ++j)
            worst = std::max(worst, std::abs(std::norm(value(at[j % per_axis], at[j / per_axis])) -
                                             std::norm(truth[j])));
        return 4 * worst / (area_ * area_) + rounding;
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

std::unique_ptr<const Aperture> make_aperture(const AnnularPupil &pupil) {
    return std::make_unique<GeometricAperture<AnnularPupil>>(pupil, lit_parts(pupil),
                                                             2 * pupil.outer_radius, 0.0);
}

} // namespace wfpsf
