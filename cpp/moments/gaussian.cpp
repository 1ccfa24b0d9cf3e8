// SPDX-License-Identifier: GPL-3.0-or-later
#include "moments/gaussian.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wfpsf {

double WhitenedStep::norm() const {
    return std::max(std::hypot(t, v), std::sqrt(htt * htt + hs * hs + hvv * hvv));
}

double Gaussian::major_variance() const {
    return (Mxx + Myy) / 2 + std::hypot((Mxx - Myy) / 2, Mxy);
}

double Gaussian::minor_variance() const {
    return det() / major_variance();
}

double Gaussian::root_yy() const {
    return std::sqrt(Myy);
}

double Gaussian::s() const {
    return std::sqrt(Mxx - Mxy * Mxy / Myy);
}

Gaussian Gaussian::moved(const WhitenedStep &step) const {
    const double l00 = s(), l11 = root_yy(), l01 = shear() * l11;
    // exp of the symmetric matrix H = mean + ((d, b), (b, -d)).
    const double mean = (step.htt + step.hvv) / 2, d = (step.htt - step.hvv) / 2;
    const double b = step.hs / std::numbers::sqrt2, r = std::hypot(d, b);
    const double scale = std::exp(mean);
    const double even = scale * std::cosh(r), odd = scale * (r > 0 ? std::sinh(r) / r : 1);
    const double ett = even + odd * d, etv = odd * b, evv = even - odd * d;
    Gaussian g;
    g.x = x + l00 * step.t + l01 * step.v;
    g.y = y + l11 * step.v;
    g.Mxx = l00 * l00 * ett + 2 * l00 * l01 * etv + l01 * l01 * evv;
    g.Mxy = l11 * (l00 * etv + l01 * evv);
    g.Myy = l11 * l11 * evv;
    return g;
}

double whitened_distance(const Gaussian &from, const Gaussian &to) {
    const double s = from.s(), l = from.root_yy(), k = from.shear();
    const double dx = to.x - from.x, dy = to.y - from.y;
    const double xx = to.Mxx - from.Mxx, xy = to.Mxy - from.Mxy, yy = to.Myy - from.Myy;
    const double htt = (xx - 2 * k * xy + k * k * yy) / (s * s);
    const double htv = (xy - k * yy) / (s * l), hvv = yy / (l * l);
    return WhitenedStep{(dx - k * dy) / s, dy / l, htt, std::numbers::sqrt2 * htv, hvv}.norm();
}

} // namespace wfpsf
