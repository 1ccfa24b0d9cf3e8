// SPDX-License-Identifier: GPL-3.0-or-later
// Filters over a whole image by its transform. What continues the image beyond its border decides
// which transform makes a convolution a product.
#pragma once

#include "image/view.hpp"

#include <complex>
#include <functional>
#include <vector>

namespace wfpsf {

enum class Continuation {
    periodic, // Fourier transform
    odd,      // zero one sample beyond the border, odd about there: sine transform
    even,     // even about the border, half a sample beyond the last: cosine transform
};

// The frequencies of an axis of n samples in cycles per sample, in the order of the transform. The
// first axis of a periodic image has n / 2 + 1 of them.
std::vector<double> filter_frequencies(Continuation continuation, int64_t n, bool first_axis);

// Writes the factors of all first frequencies at the k-th second frequency, conjugated as for a sum
// over exp(-2 pi i f x). They are real unless the image is periodic.
using FilterRow = std::function<void(int64_t k, std::complex<double> *factors)>;

// Multiplies the transform of an image, in place. The image is contiguous.
void filter_plane(View<double> image, Continuation continuation, const FilterRow &row);

} // namespace wfpsf
