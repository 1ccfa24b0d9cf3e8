// SPDX-License-Identifier: GPL-3.0-or-later
// Adaptive moments: the elliptical Gaussian weight that matches the object (Kannawadi et al. 2016,
// section 3.1). With the matched weight w = exp(-rho^2/2) a Gaussian object of covariance M has
// weighted second moments M/2, so the fixed point is M = 2 <(x - x0)(x - x0)^T>; the paper's Eq. 13
// leaves the factor out.
#pragma once

#include "image/view.hpp"
#include "moments/fit_target.hpp"
#include "moments/gaussian.hpp"

#include <optional>
#include <string>

#include <wfpsf/status.h>

namespace wfpsf {

struct AdaptiveOptions {
    // Error asked for, in whitened units: the larger of |L^-1 dx0| and ||L^-1 dM L^-T||, M = L L^T.
    // 1e-12 to 0.1.
    double tolerance = 1e-8;
    int max_passes = 100; // from each start
    // An iterate whose minor axis falls below this (pixels) has collapsed on a pixel.
    double sigma_min = 0.25;
    MomentsMethod method = MomentsMethod::adaptive;
    double background = 0; // taken off every pixel; of no effect where one is fitted
    bool restart = true;   // from scale_space_start(), if the guess leads to no solution
};

struct AdaptiveMoments {
    wfpsf_status status = WFPSF_OK;
    std::string line;      // what went wrong, empty if nothing did
    Gaussian weight;       // x0 and M: the solution, or the last iterate
    double flux = 0;       // of the best-fit Gaussian: 2 sum(w I) if no pixel is missing
    double background = 0; // given, or fitted
    double rho4 = 0;       // sum(w I rho^4)/sum(w I), 2 for a Gaussian; good to about last_step
    // Of the weighted moments under a round weight; elsewhere those of M.
    double e1 = 0;       // (Mxx - Myy)/(Mxx + Myy), Eq. 14
    double e2 = 0;       // 2 Mxy/(Mxx + Myy)
    int passes = 0;      // over the pixels, all starts together
    int64_t pixels = 0;  // visited, all passes together
    double gradient = 0; // norm of the merit function's gradient at the last pass
    double last_step = 0;
    double error_estimate = 0;   // whitened: iteration, truncation of the weight, and rounding
    double curvature = 0;        // smallest eigenvalue of -Hessian; 1/8 for a Gaussian
    double edge_fraction = 0;    // share of the weight function's integral beyond the border
    double missing_fraction = 0; // share of the integral of w^2 on missing pixels

    double sigma() const;       // det(M)^(1/4)
    double sigma_trace() const; // sqrt(Mxx + Myy)
    double e() const;
    double beta() const;      // position angle of the major axis from x towards y, radians, Eq. 15
    double amplitude() const; // A of Eq. 17: flux/(2 pi sqrt(det M))
};

// Finds x0 and M. Without a guess, or if the iteration fails from it, starts at
// scale_space_start(). A guess narrower than 1.2 pixels is widened to that. Whatever the pixels
// hold, a status comes back: see status.h, codes 1xx, ERROR_NOT_FINITE and ERROR_MOMENTS_xxx.
// Pixels that are not finite do no harm beyond the reach of the weight (rho about 6 to 9), nor
// where `missing`, if it is not empty, is not zero. Throws Error if an option or the guess lies
// outside its range.
template <class T>
AdaptiveMoments adaptive_moments(View<const T> image, const std::optional<Gaussian> &guess = {},
                                 const AdaptiveOptions &options = {},
                                 View<const float> missing = {});

} // namespace wfpsf
