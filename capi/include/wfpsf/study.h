/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file study.h
 * The paper in one call: the tables of Kannawadi et al. 2016, the grids of its figures, and what
 * follows from them for the mission.
 *
 * A study is of one detector's PSFs at the bands' effective wavelengths (WFPSF_BAND_PAPER), before
 * and after IPC; the table of requirements is of all detectors. Thread-safety: a study is
 * immutable.
 */
#ifndef WFPSF_STUDY_H
#define WFPSF_STUDY_H

#include <wfpsf/instrument.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wfpsf_study wfpsf_study;

/**
 * X(NAME, key, file, text): the tables. Each has a header of column names; wfpsf_study_write_csv()
 * writes it to `file`.csv. Rows with struts 0 are of the bare annulus. `paper` is what the paper
 * prints, for its instrument and SCA. Sensitivities are (1/q) dq/dp of sizes q, dq/dp of e1 and e2,
 * at alpha = 0.02, alpha' = 0.002, alpha+ = 0; `second_derivative` is the second one in the same
 * units: half of it times dp^2 is what a linear law neglects.
 */
#define WFPSF_STUDY_TABLE_LIST(X)                                                                  \
    X(BANDS, 10, "table_bands", "wavelengths of the bands (Table 1), nm")                          \
    X(SIZES, 20, "table_sizes", "sizes and ellipticities, with and without IPC (Table 2)")         \
    X(SENSITIVITIES, 30, "table_sensitivities",                                                    \
      "derivatives: exact ones, and those fitted on the paper's grids (Tables 3 and 4)")           \
    X(LINEAR_LAW, 40, "table_linear_law",                                                          \
      "largest error of the linear laws on those grids, over the largest change there")            \
    X(FIGURE_3, 103, "figure_03", "relative increase of sigma, percent, by alpha and alpha'")      \
    X(FIGURE_4, 104, "figure_04", "relative increase of EE50 about the centroid, percent")         \
    X(FIGURE_5, 105, "figure_05", "change of e1 by alpha and alpha'")                              \
    X(FIGURE_6, 106, "figure_06", "change of e2 by alpha and alpha'")                              \
    X(FIGURE_7, 107, "figure_07", "change of e1 by alpha and alpha+, alpha' = 0.002")              \
    X(FIGURE_8, 108, "figure_08", "change of e2 by alpha and alpha+, alpha' = 0.002")              \
    X(FIGURE_9, 109, "figure_09", "relative change of sigma, percent, about the nominal IPC")      \
    X(FIGURE_10, 110, "figure_10", "1000 times the change of e1 about the nominal IPC")            \
    X(FIGURE_11, 111, "figure_11", "1000 times the change of e2 about the nominal IPC")            \
    X(REQUIREMENTS, 200, "table_requirements",                                                     \
      "section 6, all detectors: what errors of 1e-4 do, and the largest ones allowed")            \
    X(COMPARISON, 210, "table_comparison",                                                         \
      "the paper's values, the peer's and these, with the reason for each difference above 1%")    \
    X(CONVERGENCE, 220, "table_convergence", "errors against the oversampling N")

#define WFPSF_STUDY_ENUM(name, key, file, text) WFPSF_STUDY_##name = (key),
enum { WFPSF_STUDY_TABLE_LIST(WFPSF_STUDY_ENUM) };
#undef WFPSF_STUDY_ENUM

/**
 * Does the whole study.
 *
 * Given:    instrument  may be freed afterwards
 *           sca         1..n_sca
 *           options     EPS; STRUTS of the figures, requirements, convergence and the derivatives
 *                       that are not by IPC (the other tables have both); PISTON_TILT, FRAME,
 *                       JITTER_*, CHARGE_DIFFUSION, PIXEL_RESPONSE, extra Zernikes, an OPD map,
 *                       MEMORY_LIMIT and the progress function
 * Returned: out         the handle; NULL on failure
 * Status:   WARNING_NOT_CERTIFIED if the error estimate of a size, relative, or of an ellipticity
 *           stays above 4 EPS;
 *           ERROR_NULL, ERROR_RANGE, ERROR_NO_MEMORY, ERROR_CANCELLED, ERROR_MEMORY_LIMIT; the
 *           status of moments (ERROR_MOMENTS_*) that do not exist, for PSFs too large or too odd
 */
WFPSF_EXPORT wfpsf_status wfpsf_study_create(const wfpsf_instrument *instrument, int32_t sca,
                                             const wfpsf_options *options, wfpsf_study **out);

/** Frees a study; NULL is allowed. */
WFPSF_EXPORT void wfpsf_study_destroy(wfpsf_study *study);

/**
 * The size of a table.
 *
 * Given:    table          WFPSF_STUDY_*
 * Returned: rows, columns  either may be NULL
 * Status:   ERROR_NULL, ERROR_UNKNOWN_NAME
 */
WFPSF_EXPORT wfpsf_status wfpsf_study_size(const wfpsf_study *study, int32_t table, int64_t *rows,
                                           int64_t *columns);

/**
 * The name of a column, from 0; a string that lives as long as the study, NULL past the last one or
 * if the study is NULL or has no such table.
 */
WFPSF_EXPORT const char *wfpsf_study_column(const wfpsf_study *study, int32_t table,
                                            int64_t column);

/**
 * One number.
 *
 * Given:    table        WFPSF_STUDY_*
 *           row, column  from 0
 * Returned: value        in the unit that the row, the column or the table's text states; NaN where
 *                        nothing is known, or where words stand
 * Status:   ERROR_NULL, ERROR_UNKNOWN_NAME, ERROR_RANGE
 */
WFPSF_EXPORT wfpsf_status wfpsf_study_value(const wfpsf_study *study, int32_t table, int64_t row,
                                            int64_t column, double *value);

/**
 * The words in a place, such as a band's name.
 *
 * Given:    table        WFPSF_STUDY_*
 *           row, column  from 0
 * Returned: a string that lives as long as the study; NULL where a number stands and where there is
 *           no such place
 */
WFPSF_EXPORT const char *wfpsf_study_text(const wfpsf_study *study, int32_t table, int64_t row,
                                          int64_t column);

/**
 * Writes every table as CSV into a folder that exists, replacing files that are there.
 *
 * Given:    folder  its path
 * Status:   ERROR_NULL, ERROR_FILE_WRITE
 */
WFPSF_EXPORT wfpsf_status wfpsf_study_write_csv(const wfpsf_study *study, const char *folder);

#ifdef __cplusplus
}
#endif

#endif
