// SPDX-License-Identifier: GPL-3.0-or-later
// Extended sources: an oversampled image of the source, convolved with the effective PSF.
#pragma once

#include "image/view.hpp"
#include "optics/psf.hpp"

namespace wfpsf {

// The source's image has `oversampling` samples a native pixel, its values are the flux of each
// sample, and its centre lies at (x, y), samples of `out`.
template <class S> struct Source {
    View<const S> samples;
    int64_t oversampling;
    double x, y, flux; // flux multiplies the samples
};

// out(p) = flux * sum over the source's samples q of source(q) PSF(p - q): Psf::draw() of a star
// for every sample, added up. Overwrites `out`; light that leaves it does not come back on the
// other side. `out` has `oversampling` samples a native pixel, of which the source's are a
// multiple.
template <class S, class T>
void convolve(const Psf &psf, const Source<S> &source, int64_t oversampling, View<T> out);

} // namespace wfpsf
