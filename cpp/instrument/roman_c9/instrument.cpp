// SPDX-License-Identifier: GPL-3.0-or-later
#include "instrument/nominal_ipc_kernel.hpp"
#include "instrument/roman_c9/tables.hpp"

namespace wfpsf::roman_c9 {

Instrument instrument() {
    return {.name = "roman-c9",
            .constants = constants(),
            .bands = bands(),
            .all_field_points = field_points(),
            .pupils = pupils(),
            .ipc_kernel = nominal_ipc_kernel(),
            .pixels = {4088, 4088},
            .wcs = wcs()};
}

} // namespace wfpsf::roman_c9
