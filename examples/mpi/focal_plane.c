/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Exposures of the whole focal plane, shared out among the ranks of MPI:
 *
 *     mpirun -n 4 focal_plane FOLDER [EXPOSURES [STARS [DETECTORS [STORES]]]]
 *
 * Every detector of every exposure is a piece of work; rank r takes pieces r, r + size, ... The
 * files do not depend on the number of ranks: what is random in a detector is drawn by the
 * exposure's number, the detector and the pixel. A run that was broken off is run again: files that
 * are there are kept. A rank holds one detector at a time, about 0.3 GiB.
 *
 * With a folder STORES, PSFs of each detector are made once and kept there for all exposures of this
 * run and others; pixels then depend on what the stores hold, within the budget.
 */
#include <math.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>

#include <wfpsf/wfpsf.h>

static void check(wfpsf_status status) {
    if (status >= 0)
        return;
    char line[512];
    wfpsf_last_error(line, sizeof line);
    fprintf(stderr, "%s: %s\n", wfpsf_status_name(status), line);
    MPI_Abort(MPI_COMM_WORLD, 1);
}

/* The same numbers on every rank: a linear congruential generator (Knuth's MMIX). */
static double uniform(uint64_t *state) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 9007199254740992.0;
}

/* Stars over 0.9 degrees around the pointing, magnitudes 18 to 27, counts rising as 10^(0.3 m). */
static wfpsf_catalogue *make_catalogue(double ra, double dec, int64_t count) {
    double *x = malloc((size_t)count * sizeof *x), *y = malloc((size_t)count * sizeof *y);
    double *magnitude = malloc((size_t)count * sizeof *magnitude);
    if (!x || !y || !magnitude)
        MPI_Abort(MPI_COMM_WORLD, 1);
    uint64_t state = 2026;
    const double cosine = cos(dec * 3.14159265358979 / 180), least = pow(10, 0.3 * (18 - 27));
    for (int64_t i = 0; i < count; ++i) {
        x[i] = ra + 0.9 * (uniform(&state) - 0.5) / cosine;
        y[i] = dec + 0.9 * (uniform(&state) - 0.5);
        magnitude[i] = 27 + log10(least + uniform(&state) * (1 - least)) / 0.3;
    }
    wfpsf_catalogue *catalogue;
    wfpsf_sed *sed;
    check(wfpsf_catalogue_create(WFPSF_POSITIONS_SKY, WFPSF_BRIGHTNESS_AB_MAGNITUDE, &catalogue));
    check(wfpsf_sed_create_black_body(5000, &sed));
    check(wfpsf_catalogue_add_colour(catalogue, 0, sed, NULL));
    check(wfpsf_catalogue_add_stars(catalogue, count, x, y, magnitude, NULL));
    wfpsf_sed_destroy(sed);
    free(x);
    free(y);
    free(magnitude);
    return catalogue;
}

/* What exposures of a detector share, from its file if there is one that serves. */
static wfpsf_scene_store *open_store(const char *path) {
    wfpsf_scene_store *store;
    check(wfpsf_scene_store_create(&store));
    const wfpsf_status status = wfpsf_scene_store_read(store, path);
    if (status != WFPSF_ERROR_FILE_OPEN && status != WFPSF_ERROR_FILE_FORMAT)
        check(status);
    return store;
}

static int64_t memory_of(const wfpsf_scene_store *store) {
    int64_t bytes;
    check(wfpsf_scene_store_memory(store, &bytes));
    return bytes;
}

int main(int argc, char **argv) {
    MPI_Init(&argc, &argv);
    int rank, size;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    const char *folder = argc > 1 ? argv[1] : ".";
    const int exposures = argc > 2 ? atoi(argv[2]) : 1;
    const int64_t stars = argc > 3 ? atoll(argv[3]) : 100000;
    const int detectors = argc > 4 ? atoi(argv[4]) : 18;
    const char *stores = argc > 5 ? argv[5] : NULL;
    const double ra = 53.1, dec = -27.8, dither = 0.02; /* degrees */

    wfpsf_instrument *roman;
    wfpsf_options *options;
    wfpsf_chain *chain;
    check(wfpsf_instrument_create("roman-c9", &roman));
    check(wfpsf_options_create(&options));
    check(wfpsf_options_set_real(options, WFPSF_OPTION_SCENE_NOISE, 0.1));
    check(wfpsf_options_set_real(options, WFPSF_OPTION_SCENE_BACKGROUND, 40));
    check(wfpsf_chain_create_default(roman, 139.8, &chain));
    wfpsf_catalogue *catalogue = make_catalogue(ra, dec, stars);

    int made_here = 0, kept_here = 0;
    const double start = MPI_Wtime();
    check(wfpsf_options_set_integer(options, WFPSF_OPTION_SCENE_EXPOSURES, exposures));
    for (int sca = 1; sca <= detectors; ++sca) {
        char path[512];
        wfpsf_scene_store *store = NULL; /* from this rank's first piece of the detector on */
        int64_t in_file = 0;
        for (int number = 0; number < exposures; ++number) {
            if ((number * detectors + sca - 1) % size != rank)
                continue;
            if (stores && !store) {
                snprintf(path, sizeof path, "%s/sca%02d_J129.store", stores, sca);
                store = open_store(path);
                in_file = memory_of(store);
                check(wfpsf_options_set_scene_store(options, store));
            }
            wfpsf_observation *observation;
            wfpsf_exposure *exposure;
            check(
                wfpsf_observation_create(roman, ra + number * dither, dec, 30, NULL, &observation));
            check(wfpsf_options_set_integer(options, WFPSF_OPTION_STREAM, number));
            check(wfpsf_exposure_create(roman, observation, "J129", catalogue, chain, options,
                                        &exposure));
            int32_t made;
            check(wfpsf_exposure_make(exposure, sca, folder, options, &made));
            made ? ++made_here : ++kept_here;
            wfpsf_exposure_destroy(exposure);
            wfpsf_observation_destroy(observation);
        }
        if (store && memory_of(store) > in_file)
            check(wfpsf_scene_store_write(store, path));
        check(wfpsf_options_set_scene_store(options, NULL));
        wfpsf_scene_store_destroy(store);
    }

    int counts[2] = {made_here, kept_here}, all[2];
    MPI_Reduce(counts, all, 2, MPI_INT, MPI_SUM, 0, MPI_COMM_WORLD);
    if (rank == 0)
        printf("%d detectors made, %d kept, by %d ranks in %.1f s\n", all[0], all[1], size,
               MPI_Wtime() - start);
    wfpsf_catalogue_destroy(catalogue);
    wfpsf_chain_destroy(chain);
    wfpsf_options_destroy(options);
    wfpsf_instrument_destroy(roman);
    MPI_Finalize();
    return 0;
}
