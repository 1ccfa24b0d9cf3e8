// SPDX-License-Identifier: GPL-3.0-or-later
#include "instrument/nominal_ipc_kernel.hpp"
#include "instrument/wfirst_afta_c5/tables.hpp"

namespace wfpsf::wfirst_afta_c5 {

Instrument instrument() {
    static const Pupil common = pupil();
    return {.name = "wfirst-afta-c5",
            .constants = constants(),
            .bands = bands(),
            .all_field_points = field_points(),
            .pupils = {&common, 1},
            .ipc_kernel = nominal_ipc_kernel(),
            .pixels = {4088, 4088},
            .wcs = wcs()};
}

} // namespace wfpsf::wfirst_afta_c5
