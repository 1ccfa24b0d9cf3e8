/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A host that plans and runs FFTW transforms of its own while other threads make PSFs of all sizes,
   hand them on, and a thread that did not make them destroys them. */
#include "pixels.h"

#include <pthread.h>

#include <fftw3.h>

enum { rounds = 12, longest = 64 };

static const wfpsf_instrument *instrument;
static wfpsf_psf *made[rounds];

static void *make_psfs(void *unused) {
    (void)unused;
    for (int i = 0; i < rounds; ++i) {
        wfpsf_options *options = NULL;
        CHECK_OK(wfpsf_options_create(&options));
        CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_PSF_RADIUS, 3 + i));
        CHECK_OK(wfpsf_psf_create(instrument, 1 + i, 1000 + 50.0 * i, options, &made[i]));
        wfpsf_options_destroy(options);
    }
    return NULL;
}

/* exp(2 pi i l / n) forwards is n at 1 and 0 elsewhere. */
static void *transform(void *unused) {
    (void)unused;
    for (int i = 0; i < 4 * rounds; ++i) {
        const int n = 2 + i % (longest - 1);
        fftw_complex *data = fftw_alloc_complex((size_t)n);
        fftw_plan plan = fftw_plan_dft_1d(n, data, data, FFTW_FORWARD, FFTW_ESTIMATE);
        for (int l = 0; l < n; ++l) {
            data[l][0] = cos(2 * acos(-1.0) * l / n);
            data[l][1] = sin(2 * acos(-1.0) * l / n);
        }
        fftw_execute(plan);
        for (int k = 0; k < n; ++k) {
            CHECK_NEAR(data[k][0], k == 1 % n ? n : 0, 1e-12);
            CHECK_NEAR(data[k][1], 0, 1e-12);
        }
        fftw_destroy_plan(plan);
        fftw_free(data);
    }
    return NULL;
}

int main(void) {
    pthread_t maker, host;
    double pixels[9 * 9], value = 0;
    wfpsf_instrument *c5 = NULL;
    wfpsf_image *image = wrap(pixels, 9, 9);
    CHECK_OK(wfpsf_instrument_create("wfirst-afta-c5", &c5));
    instrument = c5;
    CHECK(pthread_create(&maker, NULL, make_psfs, NULL) == 0);
    CHECK(pthread_create(&host, NULL, transform, NULL) == 0);
    CHECK(pthread_join(maker, NULL) == 0);
    CHECK(pthread_join(host, NULL) == 0);
    for (int i = 0; i < rounds; ++i) {
        CHECK_OK(wfpsf_psf_get(made[i], WFPSF_PSF_WAVELENGTH_NM, &value));
        CHECK_NEAR(value, 1000 + 50.0 * i, 1e-9);
        CHECK_OK(wfpsf_psf_draw(made[i], 4, 4, 1, NULL, image));
        CHECK(pixels[40] > 0.05 && pixels[40] < 1);
        wfpsf_psf_destroy(made[i]);
    }
    wfpsf_image_destroy(image);
    wfpsf_instrument_destroy(c5);
    return checked();
}
