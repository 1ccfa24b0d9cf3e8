// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/ipc_star.hpp"

#include "detector/ipc_convolve.hpp"
#include "error/error.hpp"
#include "moments/moment_set.hpp"
#include "moments/unweighted.hpp"
#include "moments/weighted_sums.hpp"

#include <cmath>
#include <utility>

namespace wfpsf {

namespace {

constexpr double full_reach2 = 74; // exp(-37) is below rounding

// The kernel's derivatives by alpha, alpha' and alpha+ (Eq. 9), as tables of 3 x 3 taps.
constexpr std::array<std::array<double, 9>, ipc_parameters> tap_slopes{
    {{0, 1, 0, 1, -4, 1, 0, 1, 0}, {1, 0, 1, 0, -4, 0, 1, 0, 1}, {0, -1, 0, 1, 0, 1, 0, -1, 0}}};

template <class N> StarShape<N> native(const MomentSet<N> &m, double oversampling) {
    const Shape<N> shape = shape_of(m);
    const N scale(1 / oversampling);
    return {m.x * scale, m.y * scale, shape.sigma * scale, (m.Mxx + m.Myy) * scale * scale,
            shape.e1,    shape.e2};
}

// A star's size, roughly: that of an Airy pattern and of the pixel.
double rough_sigma(double bandwidth) {
    return std::sqrt(0.43 * 0.43 / (bandwidth * bandwidth) + 1.0 / 12);
}

} // namespace

int64_t IpcStar::sufficient_oversampling(double bandwidth) {
    constexpr double pi = 3.14159265358979323846;
    constexpr double reach = 8; // exp(-32)
    return static_cast<int64_t>(std::ceil(bandwidth + reach / (2 * pi * rough_sigma(bandwidth))));
}

int64_t IpcStar::sufficient_side(double bandwidth) {
    return 2 * static_cast<int64_t>(std::ceil(2 + 9 * rough_sigma(bandwidth)));
}

IpcStar::IpcStar(const Psf &psf, int64_t oversampling, int64_t native_side)
    : IpcStar(
          [&] {
              auto image =
                  Plane<double>::unset(native_side * oversampling, native_side * oversampling);
              const double middle = static_cast<double>(image.nx() - 1) / 2;
              psf.draw({middle, middle, 1}, oversampling, image.view());
              return image;
          }(),
          oversampling) {}

IpcStar::IpcStar(Plane<double> image, int64_t oversampling)
    : oversampling_(oversampling), image_(std::move(image)) {
    for (size_t p = 0; p < ipc_parameters; ++p) {
        changes_[p] = Plane<double>::unset(side(), side());
        convolve(View<const double>{tap_slopes[p].data(), 3, 3, 1, 3}, std::as_const(image_).view(),
                 {.tap_step = oversampling}, changes_[p].view());
    }
}

std::vector<StarChange> zernike_changes(const Psf &psf, const IpcStar &star, double radius_m,
                                        size_t first_j, size_t last_j) {
    std::vector<Wavefront> by;
    std::vector<double> coefficients(last_j);
    for (size_t j = first_j; j <= last_j; ++j) {
        coefficients[j - 1] = 1;
        by.emplace_back(coefficients, radius_m);
        coefficients[j - 1] = 0;
    }
    const int64_t oversampling = star.oversampling();
    std::vector<StarChange> changes;
    for (const Field &field : psf.changes(by, field_side / 2.0)) {
        const auto drawn = [&](int64_t side) {
            Plane<double> image(side, side);
            const double centre = static_cast<double>(side - 1) / 2;
            field.draw({centre, centre, 1}, oversampling, 0, 0, image.view());
            return image;
        };
        const Plane<double> wide = drawn(field_side * oversampling);
        changes.push_back({IpcStar(drawn(star.side()), oversampling), pixel_sum(wide.view())});
    }
    return changes;
}

Plane<double> IpcStar::image(const Ipc &ipc) const {
    auto sum = Plane<double>::unset(side(), side());
    for (int64_t y = 0; y < side(); ++y) {
        const double *bare = image_.view().row(y);
        const double *by[] = {change(0).row(y), change(1).row(y), change(2).row(y)};
        double *row = sum.view().row(y);
        for (int64_t x = 0; x < side(); ++x)
            row[x] = bare[x] + ipc.alpha * by[0][x] + ipc.alpha_prime * by[1][x] +
                     ipc.alpha_plus * by[2][x];
    }
    return sum;
}

AdaptiveMoments IpcStar::measure(const Plane<double> &image,
                                 const std::optional<Gaussian> &guess) const {
    const double size = 0.6 * static_cast<double>(oversampling_);
    return adaptive_moments(
        image.view(), guess.value_or(Gaussian{centre(), centre(), size * size, 0, size * size}),
        study_moments);
}

StarShape<double> IpcStar::shape(const AdaptiveMoments &m) const {
    const Gaussian &w = m.weight;
    return native<double>({w.x - centre(), w.y - centre(), w.Mxx, w.Mxy, w.Myy, m.flux},
                          static_cast<double>(oversampling_));
}

StarSlopes::StarSlopes(const IpcStar &star, const Plane<double> &image,
                       const AdaptiveMoments &solution)
    : oversampling_(static_cast<double>(star.oversampling())), weight_(solution.weight),
      sums_(weighted_sums(image.view(), solution.weight, full_reach2)),
      sensitivity_(image.view(), solution, study_moments, {}, true) {}

StarShape<HyperDual> StarSlopes::shape(const ImageChange &change) const {
    return native(sensitivity_.along(change, change), oversampling_);
}

StarShape<HyperDual> StarSlopes::along(View<const double> change) const {
    return shape(sensitivity_.change_of(change));
}

// The change is half of C : grad grad I. In whitened coordinates C becomes L^-1 C L^-T, and each
// derivative passes, with its sign turned, from I to w t^j v^k:
//     d/dt (w t^j) = w (j t^(j-1) - t^(j+1)).
StarShape<HyperDual> StarSlopes::along_blur(const Covariance &variance) const {
    const double s = weight_.s(), l = weight_.root_yy(), k = weight_.shear();
    const double samples2 = oversampling_ * oversampling_;
    const double xx = variance.xx * samples2, xy = variance.xy * samples2;
    const double yy = variance.yy * samples2;
    const double ctt = (xx - 2 * k * xy + k * k * yy) / (s * s);
    const double ctv = (xy - k * yy) / (s * l), cvv = yy / (l * l);
    const auto at = [this](int a, int b) { return a < 0 || b < 0 ? 0 : sums_.sum[a][b]; };
    // Of sum I d^2(w t^j)/dt^2 v^b: j (j-1) t^(j-2) - (2 j + 1) t^j + t^(j+2).
    WeightedSums sums;
    for (int a = 0; a <= 2; ++a)
        for (int b = 0; a + b <= 2; ++b) {
            const double tt = a * (a - 1) * at(a - 2, b) - (2 * a + 1) * at(a, b) + at(a + 2, b);
            const double vv = b * (b - 1) * at(a, b - 2) - (2 * b + 1) * at(a, b) + at(a, b + 2);
            const double tv = a * b * at(a - 1, b - 1) - a * at(a - 1, b + 1) -
                              b * at(a + 1, b - 1) + at(a + 1, b + 1);
            sums.sum[a][b] = (ctt * tt + 2 * ctv * tv + cvv * vv) / 2;
        }
    return shape({sums});
}

} // namespace wfpsf
