/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file scene.h
 * Scenes: all sources of a catalogue on an image of a detector, each modelled as far as an error
 * budget needs.
 *
 *     wfpsf_scene_create(roman, NULL, "J129", 7, catalogue, image, 0, 0, options, &scene);
 *     wfpsf_scene_text(scene, sizeof text, text, NULL);            (the plan, to be read)
 *     wfpsf_scene_render(scene, options, image, NULL);
 *
 * The budget is SCENE_NOISE: how far a pixel may be off, in units of its noise, the square root of
 * SCENE_VARIANCE; the sources' own noise is not counted. A scene first plans: sources of one colour
 * and kind whose fluxes are within a factor of two form a group; every group is drawn in the way
 * that costs least in all, while the errors of all groups add up to no more than the budget
 * (docs/scene.md). A star far brighter than the rest is drawn to the ends of its spikes, a faint
 * one on a few pixels.
 *
 * Thread-safety: a scene is immutable; many threads may render one, each into its own image.
 */
#ifndef WFPSF_SCENE_H
#define WFPSF_SCENE_H

#include <wfpsf/catalogue.h>
#include <wfpsf/image.h>
#include <wfpsf/ipc.h>
#include <wfpsf/observation.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wfpsf_scene wfpsf_scene;

/**
 * What scenes are drawn with, kept for the next ones: PSFs of a whole detector and tables of far
 * light, of every colour, detector and band the last ones that were made. Scenes of the same optics
 * and image then plan with what is there, and make only what it will not do for: from the second
 * exposure of a detector on, most of the time is saved (docs/scene.md).
 *
 *     wfpsf_scene_store_create(&store);
 *     wfpsf_options_set_scene_store(options, store);
 *     wfpsf_options_set_integer(options, WFPSF_OPTION_SCENE_EXPOSURES, 100);
 *     for (...) { wfpsf_scene_create(...); wfpsf_scene_render(...); wfpsf_scene_destroy(...); }
 *
 * SCENE_EXPOSURES tells plans how many scenes share what they make, which may then take as many
 * times as long. How a scene is drawn, within its budget, depends on what the store holds: who needs
 * the same bits again starts from the same store. Thread-safe.
 */
typedef struct wfpsf_scene_store wfpsf_scene_store;

/**
 * An empty store.
 *
 * Returned: out     the handle; NULL on failure
 * Status:   ERROR_NULL, ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_scene_store_create(wfpsf_scene_store **out);

/** Frees a store, once no options and no scenes share it any more; NULL is allowed. */
WFPSF_EXPORT void wfpsf_scene_store_destroy(wfpsf_scene_store *store);

/**
 * What a store holds.
 *
 * Returned: bytes   about
 * Status:   ERROR_NULL
 */
WFPSF_EXPORT wfpsf_status wfpsf_scene_store_memory(const wfpsf_scene_store *store, int64_t *bytes);

/**
 * Writes what a store holds to a file, for other processes: a detector's first scene then takes no
 * longer than its further ones. The file appears whole or not at all, and takes the place of one
 * that is there. It is about as large as wfpsf_scene_store_memory() tells, and for this version of
 * the library on machines of this kind alone.
 *
 * Given:    path  of the file
 * Status:   ERROR_NULL, ERROR_FILE_WRITE, ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_scene_store_write(const wfpsf_scene_store *store, const char *path);

/**
 * Adds what a file holds that wfpsf_scene_store_write() made; the store may hold that of several.
 * A file that is damaged, or of another version, changes nothing.
 *
 * Given:    path  of the file
 * Status:   ERROR_NULL, ERROR_FILE_OPEN, ERROR_FILE_FORMAT, ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_scene_store_read(wfpsf_scene_store *store, const char *path);

/**
 * Scenes and exposures that are created with these options share a store; NULL: each makes its own.
 *
 * Status:   ERROR_NULL
 */
WFPSF_EXPORT wfpsf_status wfpsf_options_set_scene_store(wfpsf_options *options,
                                                        const wfpsf_scene_store *store);

/** X(NAME, key, text): what can be asked of a scene, as planned. */
#define WFPSF_SCENE_PROPERTY_LIST(X)                                                               \
    X(SOURCES, 10, "sources that have a place on the detector or around it")                       \
    X(GROUPS, 20, "groups of sources that are drawn alike")                                        \
    X(ERROR_ALLOWED, 30, "how far a pixel may be off, e-")                                         \
    X(ERROR_EXPECTED, 40, "how far a pixel may come to be off, e-")                                \
    X(TIME_EXPECTED, 50, "time that rendering takes with one thread, s, to a factor of two")       \
    X(MEMORY_EXPECTED, 60, "memory that rendering takes, bytes")

#define WFPSF_SCENE_PROPERTY_ENUM(name, key, text) WFPSF_SCENE_##name = (key),
enum { WFPSF_SCENE_PROPERTY_LIST(WFPSF_SCENE_PROPERTY_ENUM) };
#undef WFPSF_SCENE_PROPERTY_ENUM

/** X(NAME, key, text): what can be asked of a group. */
#define WFPSF_SCENE_GROUP_LIST(X)                                                                  \
    X(COLOUR, 10, "number of its colour in the catalogue")                                         \
    X(KIND, 20, "WFPSF_KIND_*")                                                                    \
    X(FLUX_FROM, 30, "its sources have this flux or more, up to twice as much, e-")                \
    X(SOURCES, 40, "how many sources it has")                                                      \
    X(DRAWING, 50, "WFPSF_DRAWING_*")                                                              \
    X(RADIUS, 60, "half size of the stamps, native pixels")                                        \
    X(EPS, 70, "error of the PSF, in units of its peak")                                           \
    X(FAR_FLOOR, 75, "light beyond the stamp is drawn down to that share of it; 0: none is")       \
    X(ERROR_EXPECTED, 80, "how far it may bring a pixel off, e-")                                  \
    X(TIME_EXPECTED, 90, "time that it takes, s")

#define WFPSF_SCENE_GROUP_ENUM(name, key, text) WFPSF_SCENE_GROUP_##name = (key),
enum { WFPSF_SCENE_GROUP_LIST(WFPSF_SCENE_GROUP_ENUM) };
#undef WFPSF_SCENE_GROUP_ENUM

/** What a group's sources are. */
enum { WFPSF_KIND_STAR = 1, WFPSF_KIND_GALAXY = 2 };

/** How a group's sources are drawn. */
enum {
    WFPSF_DRAWING_SHARED = 1, /**< as stars, by a model of the whole detector's PSF */
    WFPSF_DRAWING_OWN = 2,    /**< as stars, by a PSF made for each */
    /** as galaxies, by Fourier transform, with the PSF of a part of the detector */
    WFPSF_DRAWING_FOURIER = 3,
    WFPSF_DRAWING_FOURIER_OWN = 4 /**< the same with a PSF made for each */
};

/** X(NAME, key, text): what rendering came to. */
#define WFPSF_RENDERING_LIST(X)                                                                    \
    X(TIME, 10, "wall-clock time, s")                                                              \
    X(TIME_MODELS, 20, "the part of it that went into PSFs of the whole detector")                 \
    X(TIME_SHARED, 30, "the part for sources drawn with those")                                    \
    X(TIME_OWN, 40, "the part for sources with PSFs of their own")                                 \
    X(TIME_GALAXIES, 45, "the part for galaxies drawn by Fourier transform")                       \
    X(DRAWN, 50, "sources whose stamps reach the image")                                           \
    X(EXACT_PSFS, 60, "exact PSFs that were made")                                                 \
    X(ERROR_ESTIMATE, 70, "how far a pixel may be off, e-, by the PSFs as they came out")

#define WFPSF_RENDERING_ENUM(name, key, text) WFPSF_RENDERING_##name = (key),
enum { WFPSF_RENDERING_LIST(WFPSF_RENDERING_ENUM) };
#undef WFPSF_RENDERING_ENUM

typedef struct wfpsf_rendering wfpsf_rendering;

/**
 * Plans a scene.
 *
 * Given:    instrument   may be freed afterwards, as may all the others
 *           observation  of the instrument, for positions on the sky; else NULL
 *           band         such as "J129"
 *           sca          1..n_sca
 *           catalogue    its sources are copied
 *           image        its size and oversampling count; it is not touched
 *           x0, y0       position on the detector of the centre of the image's first native pixel
 *           options      SCENE_NOISE, SCENE_VARIANCE, SCENE_FLUX, EXPOSURE_TIME (for magnitudes),
 *                        SCENE_EXPOSURES and a scene store;
 *                        STRUTS, PISTON_TILT, FRAME, FIELD_RULE, JITTER_*, CHARGE_DIFFUSION, extra
 *                        Zernikes, an OPD map; THREADS, on which no bit depends. PIXEL_RESPONSE
 *                        must be 1
 * Returned: out          the handle; NULL on failure
 * Status:   ERROR_NULL, ERROR_UNKNOWN_NAME, ERROR_RANGE, ERROR_NOT_FINITE, ERROR_SIZE (an empty
 *           image), ERROR_ARGUMENT (sky positions without an observation, another instrument's),
 *           ERROR_NO_MEMORY, WARNING_NOT_CERTIFIED (no plan meets the budget)
 */
WFPSF_EXPORT wfpsf_status wfpsf_scene_create(const wfpsf_instrument *instrument,
                                             const wfpsf_observation *observation, const char *band,
                                             int32_t sca, const wfpsf_catalogue *catalogue,
                                             const wfpsf_image *image, double x0, double y0,
                                             const wfpsf_options *options, wfpsf_scene **out);

/** Frees a scene; NULL is allowed. */
WFPSF_EXPORT void wfpsf_scene_destroy(wfpsf_scene *scene);

/**
 * One property of a scene.
 *
 * Given:    key    WFPSF_SCENE_*
 * Returned: value  in the unit that the list above states
 * Status:   ERROR_NULL, ERROR_UNKNOWN_NAME
 */
WFPSF_EXPORT wfpsf_status wfpsf_scene_get(const wfpsf_scene *scene, int32_t key, double *value);

/**
 * One property of a group, as planned.
 *
 * Given:    group  from 0; the number of groups is WFPSF_SCENE_GROUPS
 *           key    WFPSF_SCENE_GROUP_*
 * Returned: value  in the unit that the list above states
 * Status:   ERROR_NULL, ERROR_RANGE, ERROR_UNKNOWN_NAME
 */
WFPSF_EXPORT wfpsf_status wfpsf_scene_get_group(const wfpsf_scene *scene, int64_t group,
                                                int32_t key, double *value);

/**
 * Which source got what: the group of each.
 *
 * Given:    count   of sources of the catalogue
 * Returned: group   count integers in the catalogue's order, from 0; -1: it has no place
 * Status:   ERROR_NULL, ERROR_SIZE (another count than the catalogue's)
 */
WFPSF_EXPORT wfpsf_status wfpsf_scene_groups_of(const wfpsf_scene *scene, int64_t count,
                                                int32_t *group);

/**
 * The plan as text, a line a group.
 *
 * Given:    capacity  bytes that `text` has room for, >= 0
 * Returned: text      the first capacity - 1 characters, closed by NUL; may be NULL if capacity is 0
 *           length    of the whole text, without the NUL; may be NULL
 * Status:   ERROR_NULL, ERROR_SIZE
 */
WFPSF_EXPORT wfpsf_status wfpsf_scene_text(const wfpsf_scene *scene, int64_t capacity, char *text,
                                           int64_t *length);

/**
 * Adds all sources to an image. Its pixels are electrons.
 *
 * Given:    options  THREADS, which changes the time and no bit of the result; MEMORY_LIMIT, the
 *                    progress function; FORCE
 * Returned: image    of the size and oversampling that the scene was planned for; pixels and
 *                    record, which must hold no effect beyond pixel response and background
 *           out      what it came to; NULL: not asked for. Freed by wfpsf_rendering_destroy()
 * Status:   ERROR_NULL, ERROR_SIZE, ERROR_ARGUMENT, ERROR_ALREADY_APPLIED: the image is then
 *           untouched; ERROR_CANCELLED, ERROR_MEMORY_LIMIT, ERROR_NO_MEMORY leave a part of the
 *           light in it; WARNING_NOT_CERTIFIED (the estimate is above the budget)
 */
WFPSF_EXPORT wfpsf_status wfpsf_scene_render(const wfpsf_scene *scene, const wfpsf_options *options,
                                             wfpsf_image *image, wfpsf_rendering **out);

/** Frees a rendering; NULL is allowed. */
WFPSF_EXPORT void wfpsf_rendering_destroy(wfpsf_rendering *rendering);

/**
 * One property of a rendering.
 *
 * Given:    key    WFPSF_RENDERING_*
 * Returned: value  in the unit that the list above states
 * Status:   ERROR_NULL, ERROR_UNKNOWN_NAME
 */
WFPSF_EXPORT wfpsf_status wfpsf_rendering_get(const wfpsf_rendering *rendering, int32_t key,
                                              double *value);

/** X(NAME, column, text): columns of the truth table. NaN where there is no answer. */
#define WFPSF_TRUTH_LIST(X)                                                                        \
    X(GROUP, 0, "group of the source; -1: it has no place, and all else is NaN")                   \
    X(POSITION_X, 1, "position on the detector, pixels")                                           \
    X(POSITION_Y, 2, "position on the detector, pixels")                                           \
    X(FLUX, 3, "e-, all of it")                                                                    \
    X(FLUX_IN_STAMP, 4, "e- that its stamp holds, if it lies within the image")                    \
    X(STATUS, 5, "status of the moments, wfpsf_status; of those after IPC if these are sound")     \
    X(CENTROID_X, 6, "centroid on the detector, pixels")                                           \
    X(CENTROID_Y, 7, "centroid on the detector, pixels")                                           \
    X(SIGMA, 8, "size sigma, native pixels")                                                       \
    X(E1, 9, "ellipticity e1")                                                                     \
    X(E2, 10, "ellipticity e2")                                                                    \
    X(IPC_CENTROID_X, 11, "the same after IPC")                                                    \
    X(IPC_CENTROID_Y, 12, "the same after IPC")                                                    \
    X(IPC_SIGMA, 13, "the same after IPC")                                                         \
    X(IPC_E1, 14, "the same after IPC")                                                            \
    X(IPC_E2, 15, "the same after IPC")

#define WFPSF_TRUTH_ENUM(name, column, text) WFPSF_TRUTH_##name = (column),
enum { WFPSF_TRUTH_LIST(WFPSF_TRUTH_ENUM) };
#undef WFPSF_TRUTH_ENUM

/** How many columns there are. */
enum { WFPSF_TRUTH_COLUMNS = 16 };

/**
 * What is true of some sources: adaptive moments of each as it is seen through its PSF and pixel,
 * at pixel/4, without noise and neighbours, before and after IPC. About 0.2 ms a star; a galaxy takes
 * the OTF of its place, about 0.1 s, or 1 s of many wavelengths.
 *
 * Given:    count    of sources asked about, >= 0
 *           sources  count numbers of sources in the catalogue, from 0; NULL: the first `count`
 *           kernel   of native pixels; NULL: no IPC, its columns are NaN
 *           options  EPS of the PSFs, MOMENTS_TOLERANCE, THREADS
 * Returned: values   count * WFPSF_TRUTH_COLUMNS numbers, source by source
 * Status:   ERROR_NULL, ERROR_SIZE, ERROR_RANGE, ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_scene_truth(const wfpsf_scene *scene, int64_t count,
                                            const int64_t *sources, const wfpsf_ipc_kernel *kernel,
                                            const wfpsf_options *options, double *values);

#ifdef __cplusplus
}
#endif

#endif
