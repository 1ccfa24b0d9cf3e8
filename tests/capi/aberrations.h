/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Options that leave a perfect annulus: no struts, the detector's aberrations cancelled. */
#ifndef WFPSF_TESTS_ABERRATIONS_H
#define WFPSF_TESTS_ABERRATIONS_H

#include "check.h"

static inline wfpsf_options *perfect_annulus(const wfpsf_instrument *instrument, int32_t sca,
                                             double eps, double radius) {
    wfpsf_options *options = NULL;
    double coefficients[32];
    int64_t count = 0;
    CHECK_OK(wfpsf_instrument_zernikes(instrument, sca, 32, coefficients, &count));
    for (int64_t i = 0; i < count; ++i)
        coefficients[i] = i < 3 ? 0 : -coefficients[i]; /* the first three are dropped as it is */
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_zernikes(options, count, coefficients));
    CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_STRUTS, 0));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_EPS, eps));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_PSF_RADIUS, radius));
    return options;
}

#endif
