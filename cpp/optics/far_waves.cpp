// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/far_waves.hpp"

#include "numerics/dispatch.hpp"
#include "numerics/phasor.hpp"
#include "optics/fresnel.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace wfpsf {

namespace {

// exp(2 pi i turns) along a row, by rotation.
class Turning {
  public:
    [[gnu::always_inline]] explicit Turning(const Ramps &turns) {
        for (size_t q = 0; q < lanes; ++q) {
            phasor(turns.start[q], now_.re[q], now_.im[q]);
            phasor(turns.step[q], step_.re[q], step_.im[q]);
        }
    }
    // The next point's are for the next time.
    [[gnu::always_inline]] void take(size_t q, double &re, double &im) {
        re = now_.re[q];
        im = now_.im[q];
        now_.re[q] = re * step_.re[q] - im * step_.im[q];
        now_.im[q] = re * step_.im[q] + im * step_.re[q];
    }

  private:
    Waves now_, step_;
};

} // namespace

WFPSF_VECTORISED void integrate(std::span<const EdgeNode> nodes, const Lanes &per_metre,
                                double middle, std::span<EdgeSample> out) {
    std::vector<Turning> waves;
    waves.reserve(nodes.size());
    for (const EdgeNode &node : nodes) {
        Ramps turns;
        for (size_t q = 0; q < lanes; ++q) {
            turns.step[q] = per_metre[q] * node.s;
            turns.start[q] = node.turns[q] - middle * turns.step[q];
        }
        waves.emplace_back(turns);
    }
    for (EdgeSample &sample : out) {
        Waves constant{}, slope{};
        for (size_t i = 0; i < nodes.size(); ++i) {
            const EdgeNode &node = nodes[i];
            for (size_t q = 0; q < lanes; ++q) {
                double re, im;
                waves[i].take(q, re, im);
                constant.re[q] += node.weight * re;
                constant.im[q] += node.weight * im;
                slope.re[q] += node.slope[q] * re;
                slope.im[q] += node.slope[q] * im;
            }
        }
        sample = {constant, slope};
    }
}

WFPSF_VECTORISED void add_edge(std::span<const EdgeSample> table, Ramp position, const Lanes &share,
                               Ramp factor, const Ramps &turns, std::span<Waves> row) {
    const double last = static_cast<double>(table.size()) - 3;
    Turning turning(turns);
    for (size_t j = 0; j < row.size(); ++j) {
        // Lagrange's cubic.
        const double place = position.at(j), at = std::clamp(place, 1.0, last);
        const double f = at == place ? factor.at(j) : 0;
        const auto cell = static_cast<int32_t>(at);
        const double s = at - cell, a = s + 1, b = s - 1, c = s - 2;
        const double sixth = f / 6, w[] = {-sixth * s * b * c, 3 * sixth * a * b * c,
                                           -3 * sixth * a * s * c, sixth * a * s * b};
        const EdgeSample *sample = table.data() + cell - 1;
        for (size_t q = 0; q < lanes; ++q) {
            double re = 0, im = 0, slope_re = 0, slope_im = 0;
            for (size_t k = 0; k < 4; ++k) {
                re += w[k] * sample[k].constant.re[q];
                im += w[k] * sample[k].constant.im[q];
                slope_re += w[k] * sample[k].slope.re[q];
                slope_im += w[k] * sample[k].slope.im[q];
            }
            re -= share[q] * slope_re;
            im -= share[q] * slope_im;
            double turn_re, turn_im;
            turning.take(q, turn_re, turn_im);
            row[j].re[q] += re * turn_re - im * turn_im;
            row[j].im[q] += re * turn_im + im * turn_re;
        }
    }
}

WFPSF_VECTORISED void add_arc(const Ramps &x, bool conjugate, const Lanes &scale, Ramp factor,
                              const Ramps &turns, std::span<Waves> row) {
    constexpr double first = -6, last = 60; // before that it is an arc's light by itself
    const double sign = conjugate ? -1 : 1;
    Turning turning(turns);
    for (size_t j = 0; j < row.size(); ++j) {
        const double f = factor.at(j);
        for (size_t q = 0; q < lanes; ++q) {
            const double at = x.start[q] + x.step[q] * static_cast<double>(j);
            const double weight = at > first && at < last ? f * scale[q] : 0;
            double re, im;
            fresnel_tail(at, re, im);
            im *= sign;
            double turn_re, turn_im;
            turning.take(q, turn_re, turn_im);
            row[j].re[q] += weight * (re * turn_re - im * turn_im);
            row[j].im[q] += weight * (re * turn_im + im * turn_re);
        }
    }
}

WFPSF_VECTORISED void add_part(std::span<const Waves> part, std::span<Waves> sum,
                               std::span<Lanes> each) {
    for (size_t j = 0; j < part.size(); ++j)
        for (size_t q = 0; q < lanes; ++q) {
            const double re = part[j].re[q], im = part[j].im[q];
            sum[j].re[q] += re;
            sum[j].im[q] += im;
            each[j][q] += re * re + im * im;
        }
}

WFPSF_VECTORISED void add_together(std::span<const Waves> sum, std::span<const Lanes> each,
                                   const Lanes &weight, std::span<double> light) {
    for (size_t j = 0; j < sum.size(); ++j)
        for (size_t q = 0; q < lanes; ++q) {
            const double re = sum[j].re[q], im = sum[j].im[q];
            light[j] += weight[q] * (re * re + im * im - each[j][q]);
        }
}

} // namespace wfpsf
