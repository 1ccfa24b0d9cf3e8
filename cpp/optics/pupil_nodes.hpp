// SPDX-License-Identifier: GPL-3.0-or-later
// Quadrature over the lit area of a pupil given as geometry. Each lit part is mapped smoothly from
// the unit square, so that Gauss-Legendre nodes converge exponentially; no pixels, no edges.
#pragma once

#include "instrument/pupil.hpp"

#include <cstddef>
#include <vector>

namespace wfpsf {

// Integral over the lit area of f = sum_i weight[i] f(x[i], y[i]); metres from the optical axis.
struct PupilNodes {
    std::vector<double> x, y, weight;
    size_t size() const { return x.size(); }
    void add(double node_x, double node_y, double node_weight);
};

// Nodes that integrate functions oscillating with up to `wavenumber` radians per metre to about
// `eps` of the lit area. The rounded corners of a segment are slivers with negative weights.
PupilNodes pupil_nodes(const SegmentedPupil &pupil, double wavenumber, double eps);
PupilNodes pupil_nodes(const AnnularPupil &pupil, double wavenumber, double eps);

} // namespace wfpsf
