// SPDX-License-Identifier: GPL-3.0-or-later
// Fields that the light of a star is a sum of, and how far from it each of them matters.
#pragma once

#include "image/view.hpp"
#include "optics/sum_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace wfpsf {

// The largest absolute value 0, 1, 2, ... native pixels from the middle of a field, along an axis, or
// farther.
std::vector<double> brightest_by_pixel(const Plane<double> &light, int64_t per_pixel);

// A field that counts T_i(u) T_j(v) times at place (u, v): about the star, in a plane with as many
// samples on either side of it. Beyond there is none, and stamps that take any of it lie within.
struct LightMode {
    int i, j;
    Plane<double> light;
    std::vector<double> brightest; // by pixel

    void find_brightest(int64_t per_pixel) { brightest = brightest_by_pixel(light, per_pixel); }
    double largest() const { return brightest[0]; }
    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.i, self.j, self.light, self.brightest);
    }
};

// The largest absolute value 0, 1, ... half samples, along an axis, from the middle of a square, or
// farther; row(y) is its row y = -half..half.
template <class S, class Row> std::vector<double> brightest_beyond(int64_t half, const Row &row) {
    std::vector<double> brightest(static_cast<size_t>(half + 1));
    std::vector<S> of_columns(static_cast<size_t>(2 * half + 1), S(0)); // nearer to the middle
    for (int64_t off = 0; off <= half; ++off) {
        const S *const low = row(-off), *const high = row(off);
        const auto left = static_cast<size_t>(half - off), right = static_cast<size_t>(half + off);
        brightest[static_cast<size_t>(off)] = static_cast<double>(
            std::max({of_columns[left], of_columns[right], largest(low + left, 2 * off + 1),
                      largest(high + left, 2 * off + 1)}));
        keep_largest(low, 2 * half + 1, of_columns.data());
        keep_largest(high, 2 * half + 1, of_columns.data());
    }
    for (size_t r = brightest.size() - 1; r-- > 0;)
        brightest[r] = std::max(brightest[r], brightest[r + 1]);
    return brightest;
}

// What sums of modes lack that are cut short, if each counts so many times at most. All modes have
// as many rings.
class LeftOut {
  public:
    LeftOut() = default;
    LeftOut(std::span<const LightMode> modes, std::span<const double> weights);
    // Of modes that are so bright, by mode and ring.
    LeftOut(std::span<const std::vector<double>> brightest, std::span<const double> weights);

    // All modes but the first `count`, in any pixel.
    double but_for(size_t count) const { return beyond_[count * rings_]; }
    // By mode the radius, native pixels, beyond which it may be left out of a stamp of that radius,
    // so that no pixel lacks more than `most`; modes that may be left out altogether are not
    // listed.
    std::vector<double> radii(double radius, double most) const;

  private:
    void add_up(size_t mode, const std::vector<double> &brightest, double weight);

    size_t rings_ = 1;
    std::vector<double> beyond_{0}; // [n * rings + r]: after n modes, r native pixels
};

// How far from a field's middle stamps of a radius, native pixels, take samples.
inline int64_t samples_within(double radius, int64_t per_pixel, int64_t filter) {
    return static_cast<int64_t>(std::ceil(radius * static_cast<double>(per_pixel))) + filter;
}

// Adds weight times those of `light` within `half` samples of its middle to `sum`, whose middle is
// the same place.
void add_within(double weight, const Plane<double> &light, int64_t half, Plane<double> &sum);

} // namespace wfpsf
