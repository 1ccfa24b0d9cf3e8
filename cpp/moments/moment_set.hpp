// SPDX-License-Identifier: GPL-3.0-or-later
// Centroid, matrix and flux, and the quantities that follow from them, of plain numbers or of
// numbers with derivatives.
#pragma once

#include "moments/hyper_dual.hpp"

#include <array>
#include <cstddef>

namespace wfpsf {

template <class N> struct MomentSet { N x{}, y{}, Mxx{}, Mxy{}, Myy{}, flux{}, background{}; };

template <class N> struct Shape { N sigma, sigma_trace, e1, e2, e, beta; };

template <class N> Shape<N> shape_of(const MomentSet<N> &m) {
    using std::atan2;
    using std::sqrt;
    const N trace = m.Mxx + m.Myy;
    const N e1 = (m.Mxx - m.Myy) / trace, e2 = N(2) * m.Mxy / trace;
    return {sqrt(sqrt(m.Mxx * m.Myy - m.Mxy * m.Mxy)),
            sqrt(trace),
            e1,
            e2,
            sqrt(e1 * e1 + e2 * e2),
            atan2(e2, e1) / N(2)};
}

// M of a given size det(M)^(1/2) and ellipticity.
template <class N> void set_matrix(MomentSet<N> &m, const N &root_det, const N &e1, const N &e2) {
    using std::sqrt;
    const N half_trace = root_det / sqrt(N(1) - e1 * e1 - e2 * e2);
    m.Mxx = half_trace * (N(1) + e1);
    m.Mxy = half_trace * e2;
    m.Myy = half_trace * (N(1) - e1);
}

// All quantities in one row.
inline constexpr size_t quantities = 13;
template <class N> using Quantities = std::array<N, quantities>;

template <class N> Quantities<N> quantities_of(const MomentSet<N> &m) {
    const Shape<N> s = shape_of(m);
    return {m.x,  m.y,  m.Mxx, m.Mxy,  m.Myy,  s.sigma,     s.sigma_trace,
            s.e1, s.e2, s.e,   s.beta, m.flux, m.background};
}

} // namespace wfpsf
