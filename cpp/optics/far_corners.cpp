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
    for (const EdgeEnd &end : edge_ends(edges)) {
        Corner &corner = at(end.x, end.y);
        const double rounding = end.is_curved ? 2 * per_pixel * std::abs(end.radius) : 0;
        corner.pieces.push_back({end.nx, end.ny, end.tx, end.ty, rounding});
        if (!end.is_curved)
            corner.straight.push_back(end.edge);
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
