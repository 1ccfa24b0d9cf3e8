// SPDX-License-Identifier: GPL-3.0-or-later
// Quadrature over the lit area of a pupil given as geometry. Each lit part is mapped smoothly from
// the unit square, so that Gauss-Legendre nodes converge exponentially; no pixels, no edges.
#pragma once

#include "instrument/pupil.hpp"

#include <cstddef>
#include <functional>
#include <vector>

namespace wfpsf {

// Integral over the lit area of f = sum_i weight[i] f(x[i], y[i]); metres from the optical axis.
struct PupilNodes {
    std::vector<double> x, y, weight;
    size_t size() const { return x.size(); }
};

// Takes some of the nodes; called until all are done, so that they never stand in memory together.
using NodeSink = std::function<void(const PupilNodes &)>;

// Nodes that integrate functions oscillating with up to `wavenumber` radians per metre to about
// `eps` of the lit area. The rounded corners of a segment are slivers with negative weights.
void pupil_nodes(const SegmentedPupil &pupil, double wavenumber, double eps, const NodeSink &sink);
void pupil_nodes(const AnnularPupil &pupil, double wavenumber, double eps, const NodeSink &sink);

// Nothing lit reaches beyond.
struct Box {
    double x0, x1, y0, y1;
};
Box bounds(const SegmentedPupil &pupil);
Box bounds(const AnnularPupil &pupil);

// All nodes at once.
template <class Pupil> PupilNodes pupil_nodes(const Pupil &pupil, double wavenumber, double eps) {
    PupilNodes all;
    pupil_nodes(pupil, wavenumber, eps, [&all](const PupilNodes &some) {
        all.x.insert(all.x.end(), some.x.begin(), some.x.end());
        all.y.insert(all.y.end(), some.y.begin(), some.y.end());
        all.weight.insert(all.weight.end(), some.weight.begin(), some.weight.end());
    });
    return all;
}

// Collects nodes into batches of a size that stays in the cache.
class NodeBatches {
  public:
    explicit NodeBatches(const NodeSink &sink);
    void add(double x, double y, double weight) {
        nodes_.x.push_back(x);
        nodes_.y.push_back(y);
        nodes_.weight.push_back(weight);
        if (nodes_.size() == largest)
            flush();
    }
    // Hands on what is left.
    void flush();

  private:
    static constexpr size_t largest = 1024;
    const NodeSink &sink_;
    PupilNodes nodes_;
};

} // namespace wfpsf
