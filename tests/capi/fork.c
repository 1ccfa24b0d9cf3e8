/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fork after load: a child goes on with its parent's handles, makes its own, and frees both; its
   figures are the parent's, bit for bit. Simulators fork workers once their PSFs are made. */
#include "pixels.h"

#include <sys/wait.h>
#include <unistd.h>

enum { side = 32 };

/* Two stamps: from a PSF that there is, and from one made now. */
static void draw_both(const wfpsf_psf *psf, const wfpsf_instrument *instrument,
                      double pixels[2][side * side]) {
    wfpsf_psf *own = NULL;
    wfpsf_image *first = wrap(pixels[0], side, side), *second = wrap(pixels[1], side, side);
    CHECK_OK(wfpsf_psf_draw(psf, 15.2, 16.1, 1, NULL, first));
    CHECK_OK(wfpsf_psf_create(instrument, 3, 1300, NULL, &own));
    CHECK_OK(wfpsf_psf_draw(own, 15.2, 16.1, 1, NULL, second));
    wfpsf_psf_destroy(own);
    wfpsf_image_destroy(first);
    wfpsf_image_destroy(second);
}

int main(void) {
    static double mine[2][side * side], childs[2][side * side];
    int ends[2], status = -1;
    wfpsf_instrument *instrument = NULL;
    wfpsf_psf *psf = NULL;
    CHECK_OK(wfpsf_instrument_create("wfirst-afta-c5", &instrument));
    CHECK_OK(wfpsf_psf_create(instrument, 7, 1292.11, NULL, &psf));
    CHECK(pipe(ends) == 0);

    const pid_t child = fork();
    CHECK(child >= 0);
    draw_both(psf, instrument, mine);
    if (child == 0) {
        const int written = write(ends[1], mine, sizeof mine) == (ssize_t)sizeof mine;
        wfpsf_psf_destroy(psf);
        wfpsf_instrument_destroy(instrument);
        _exit(written && checked() == 0 ? 0 : 1);
    }
    close(ends[1]);
    size_t got = 0;
    for (ssize_t part; (part = read(ends[0], (char *)childs + got, sizeof childs - got)) > 0;)
        got += (size_t)part;
    CHECK(got == sizeof childs);
    CHECK(waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0);
    CHECK(are_equal(&mine[0][0], &childs[0][0], 2 * side * side));
    wfpsf_psf_destroy(psf);
    wfpsf_instrument_destroy(instrument);
    return checked();
}
