// SPDX-License-Identifier: GPL-3.0-or-later
// A first guess from the pixels alone.
#pragma once

#include "image/view.hpp"
#include "moments/gaussian.hpp"

#include <optional>

namespace wfpsf {

// The circular Gaussian at the largest value over position and scale of (I * w_sigma)/sigma, that
// is the best of phi over circular weights on a coarse grid (scale-space selection, Lindeberg
// 1998). Scales grow by about two from 1.4 pixels on. Pixels that are not finite count as zero.
// None if no value is positive.
template <class T> std::optional<Gaussian> scale_space_start(View<const T> image);

} // namespace wfpsf
