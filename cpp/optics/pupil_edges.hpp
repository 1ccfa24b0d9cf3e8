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

// Where an edge begins or ends that is not closed.
struct EdgeEnd {
    bool is_curved;
    size_t edge;   // of its kind
    bool at_begin; // of a straight one: `from`
    double x, y;   // m
    double nx, ny; // outward normal
    double tx, ty; // onto the edge
    double radius; // of curvature, m; below 0 if the lit side is outside, without end if straight
};
std::vector<EdgeEnd> edge_ends(const PupilEdges &edges);

// Ends of two edges in one place: each pair twice, in either order.
struct Junction {
    EdgeEnd end, other;
    double kink; // radians that the outline turns by, 0..pi
};
std::vector<Junction> junctions(const PupilEdges &edges);

// Arcs that go on from a straight edge where the outline turns by less than `widest`: of each its
// beginning, and where it has turned by little when it ends its end, and what goes on from there.
struct ArcOnwards {
    size_t straight;
    EdgeEnd at;
    bool ends;   // there
    double kink; // from the straight edge to the first arc; of others none is known
};
std::vector<ArcOnwards> arcs_onwards(const PupilEdges &edges, double widest);

PupilEdges pupil_edges(const std::vector<LitPart> &parts);

} // namespace wfpsf
