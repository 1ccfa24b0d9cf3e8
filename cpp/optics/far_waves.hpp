// SPDX-License-Identifier: GPL-3.0-or-later
// Waves of several colours at once, on rows of points: what the tables of spikes are made from.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace wfpsf {

inline constexpr size_t lanes = 12; // colours that are worked on together
using Lanes = std::array<double, lanes>;
struct Waves {
    Lanes re, im;
};

// Equal steps along a row of points.
struct Ramp {
    double start, step;
    [[gnu::always_inline]] double at(size_t j) const {
        return start + step * static_cast<double>(j);
    }
};
struct Ramps {
    Lanes start, step;
};

// A point of an edge: its share of the integral of 1 along the edge, and of that of W_n.
struct EdgeNode {
    double s, weight; // m
    Lanes slope;
    Lanes turns; // phase
};

// The two integrals at a position across the spike.
struct EdgeSample {
    Waves constant, slope;
};

// out[j] = sum over nodes of exp(2 pi i (turns + (j - middle) per_metre s))
void integrate(std::span<const EdgeNode> nodes, const Lanes &per_metre, double middle,
               std::span<EdgeSample> out);

// Adds factor * (constant - share * slope) * exp(2 pi i turns) where the position is inside the
// table.
void add_edge(std::span<const EdgeSample> table, Ramp position, const Lanes &share, Ramp factor,
              const Ramps &turns, std::span<Waves> row);

// Adds factor * scale * exp(2 pi i turns) times Fresnel's tail at x, or its conjugate: an arc's
// amplitude by where its point of stationary phase stands before its end.
void add_arc(const Ramps &x, bool conjugate, const Lanes &scale, Ramp factor, const Ramps &turns,
             std::span<Waves> row);

// Adds a part's waves to the sum of all, and its light to that of each by itself.
void add_part(std::span<const Waves> part, std::span<Waves> sum, std::span<Lanes> each);

// Adds the light that all parts make together beyond that of each.
void add_together(std::span<const Waves> sum, std::span<const Lanes> each, const Lanes &weight,
                  std::span<double> light);

} // namespace wfpsf
