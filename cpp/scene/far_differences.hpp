// SPDX-License-Identifier: GPL-3.0-or-later
// How the far light of an image's places differs from that of its middle: a polynomial through
// 3 x 3 places.
#pragma once

#include "scene/middle_light.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <utility>

namespace wfpsf {

// The places along x and y in the order of FarTables::places(); those after the first, the middle,
// stand for the coefficients of x, x^2, y, y^2, x y, ... too.
inline constexpr std::array<std::pair<int, int>, 9> order_of_places{
    {{1, 1}, {0, 1}, {2, 1}, {1, 0}, {1, 2}, {0, 0}, {2, 0}, {0, 2}, {2, 2}}};

// The coefficients out to a radius, where they are above a floor.
LightBlocks far_differences(std::span<const FarLight> at_places, const MiddleLight &middle,
                            double radius, double floor, int threads);

} // namespace wfpsf
