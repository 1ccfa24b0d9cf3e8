// SPDX-License-Identifier: GPL-3.0-or-later
// The elliptical Gaussian exp(-rho^2/2), rho^2 = (x - x0)^T M^-1 (x - x0), that serves as weight
// function (Kannawadi et al. 2016, Eq. 18), and its whitened coordinates.
#pragma once

namespace wfpsf {

// A step in whitened coordinates: the centre moves by L (t, v), and M becomes L exp(H) L^T.
// hs is sqrt(2) times the off-diagonal element of H, so that |step| is the Frobenius norm.
struct WhitenedStep {
    double t = 0, v = 0, htt = 0, hs = 0, hvv = 0;

    WhitenedStep operator*(double a) const { return {a * t, a * v, a * htt, a * hs, a * hvv}; }
    double norm() const; // max(|(t, v)|, ||H||): the measure of error of all moments here
};

struct Gaussian {
    double x = 0, y = 0;              // centre, pixels
    double Mxx = 1, Mxy = 0, Myy = 1; // pixels^2

    double det() const { return Mxx * Myy - Mxy * Mxy; }
    double minor_variance() const; // smaller eigenvalue of M
    double major_variance() const;

    // The whitening factor: M = L L^T, L = ((s, k root_yy), (0, root_yy)); a point is
    // v = (y - y0)/root_yy, t = (x - x0 - k (y - y0))/s.
    double root_yy() const;
    double shear() const { return Mxy / Myy; } // k
    double s() const;

    Gaussian moved(const WhitenedStep &step) const; // M stays positive definite
};

// The distance of two solutions in units of the first: |L^-1 dx0| and ||L^-1 dM L^-T||, the larger.
double whitened_distance(const Gaussian &from, const Gaussian &to);

} // namespace wfpsf
