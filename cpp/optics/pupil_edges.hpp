// SPDX-License-Identifier: GPL-3.0-or-later
// What parts light from dark in a pupil given as geometry: pieces of straight lines and of ovals.
#pragma once

#include "optics/pupil_raster.hpp"

#include <cstddef>
#include <numbers>
#include <vector>

namespace wfpsf {

// The lit side is on the left of the way from `from` to `to`; metres.
struct StraightEdge {
    double from_x, from_y, to_x, to_y;
};

// The oval's points u = cos a, v = sin a for begin <= a <= end.
struct CurvedEdge {
    Oval oval;
    double begin, end;
    bool lit_inside;
    bool closed() const { return end - begin > 2 * std::numbers::pi - 1e-9; }
};

struct PupilEdges {
    std::vector<StraightEdge> straight;
    std::vector<CurvedEdge> curved;
};

// Where a curved edge goes on from an end of a straight one.
struct Junction {
    size_t straight, curved;
    bool at_to, at_begin; // which end of either
    double kink;          // radians that the edge turns by, 0..pi
};
std::vector<Junction> junctions(const PupilEdges &edges);

PupilEdges pupil_edges(const std::vector<LitPart> &parts);

} // namespace wfpsf
