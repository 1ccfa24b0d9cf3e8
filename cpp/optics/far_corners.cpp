// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/far_corners.hpp"

namespace wfpsf {

double Corner::most(double ux, double uy, double r, double reach) const {
    PixelBlock at;
    at.size = PixelBlock::lanes;
    for (size_t i = 0; i < at.size; ++i) {
        const double aside = (static_cast<double>(i % 3) - 1) * reach;
        at.x[i] = ux * r - uy * aside;
        at.y[i] = uy * r + ux * aside;
        at.r[i] = std::hypot(r, aside);
    }
    AmplitudeBlock sent;
    amplitudes(at, sent);
    double most = 0;
    for (size_t i = 0; i < at.size; ++i)
        most = std::max(most, std::abs(sent.im[i]));
    return most;
}

std::vector<Corner> corners(const FarSource &source, const PupilEdges &edges) {
    const double wavelength = source.mean_wavelength(), per_pixel = source.pixel() / wavelength;
    const Wavefront w = source.wavefront(wavelength);
    std::vector<Corner> all;
    const auto at = [&](double x, double y) -> Corner & {
        constexpr double together = 1e-5; // m
        for (Corner &corner : all)
            if (std::hypot(corner.x - x, corner.y - y) < together)
                return corner;
        return all.emplace_back(Corner{x, y, w(x, y), per_pixel});
    };
    for (size_t i = 0; i < edges.straight.size(); ++i) {
        const auto &[x0, y0, x1, y1] = edges.straight[i];
        const double length = std::hypot(x1 - x0, y1 - y0);
        const double tx = (x1 - x0) / length, ty = (y1 - y0) / length;
        Corner &from = at(x0, y0);
        from.pieces.push_back({ty, -tx, tx, ty, 0});
        from.straight.push_back(i);
        Corner &to = at(x1, y1);
        to.pieces.push_back({ty, -tx, -tx, -ty, 0});
        to.straight.push_back(i);
    }
    for (const CurvedEdge &edge : edges.curved) {
        if (edge.closed())
            continue;
        const Oval &o = edge.oval;
        for (const bool at_begin : {true, false}) {
            const double a = at_begin ? edge.begin : edge.end, u = std::cos(a), v = std::sin(a);
            const double dx = -o.half_width * v, dy = o.half_height * u - o.shear * v;
            const double speed = std::hypot(dx, dy), lit = edge.lit_inside ? 1 : -1;
            const double onto = at_begin ? 1 : -1, tx = dx / speed, ty = dy / speed;
            const double radius = std::pow(speed, 3) / (o.half_width * o.half_height);
            at(o.x + o.half_width * u, o.y + o.shear * u + o.half_height * v)
                .pieces.push_back(
                    {lit * ty, -lit * tx, onto * tx, onto * ty, 2 * per_pixel * radius});
        }
    }
    std::erase_if(all, [](const Corner &corner) {
        if (corner.pieces.size() != 2)
            return false;
        const auto &[a, b] = std::pair(corner.pieces[0], corner.pieces[1]);
        return std::hypot(a.tx + b.tx, a.ty + b.ty) < widest_kink;
    });
    return all;
}

} // namespace wfpsf
