# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's tables in one call."""
import ctypes

import numpy as np

from . import _lib
from ._handle import Handle
from ._library import lib
from ._names import choose, constants_of, integer, text
from ._options import chosen
from ._status import check

STUDY_TABLES = constants_of("WFPSF_STUDY_")
STUDY_OPTIONS = ("eps", "struts", "piston_tilt", "frame", "jitter_xx", "jitter_xy", "jitter_yy",
                 "charge_diffusion", "pixel_response", "memory_limit", "zernikes", "opd", "progress")


class Study(Handle):
    """The tables of Kannawadi et al. (2016) for the PSFs of detector ``sca``, made in one go.
    Immutable: threads may share it. Options as for :class:`PSF`."""

    _kind = _lib.wfpsf_study_p
    _destroy = "wfpsf_study_destroy"

    def __init__(self, instrument, sca, **options):
        with chosen(STUDY_OPTIONS, options) as handle:
            self._make(lambda out: lib.wfpsf_study_create(
                instrument, integer("sca", sca, 32), handle, out))

    def table(self, name):
        """A table as a dict of columns, arrays of numbers or lists of words:
        ``study.table("sizes")["value"]``.

        Names are "bands", "sizes", "sensitivities", "linear_law", "figure_3" to "figure_11",
        "requirements", "comparison" and "convergence"; what they hold is told in the header
        study.h.
        """
        table = choose(STUDY_TABLES, "name", name)
        rows, columns = ctypes.c_int64(), ctypes.c_int64()
        check(lib.wfpsf_study_size(self, table, rows, columns))
        return {lib.wfpsf_study_column(self, table, column).decode():
                self._column(table, rows.value, column) for column in range(columns.value)}

    def _column(self, table, rows, column):
        if rows and lib.wfpsf_study_text(self, table, 0, column) is not None:
            return [lib.wfpsf_study_text(self, table, row, column).decode()
                    for row in range(rows)]
        value, values = ctypes.c_double(), np.empty(rows)
        for row in range(rows):
            check(lib.wfpsf_study_value(self, table, row, column, value))
            values[row] = value.value
        return values

    def write_csv(self, folder):
        """Writes every table as CSV into a folder that exists, replacing files that are there."""
        check(lib.wfpsf_study_write_csv(self, text("folder", folder)))
