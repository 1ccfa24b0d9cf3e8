// SPDX-License-Identifier: GPL-3.0-or-later
#include "instrument/wfirst_afta_c5/tables.hpp"

namespace wfpsf::wfirst_afta_c5 {

Instrument instrument() {
    return {.name = "wfirst-afta-c5",
            .constants = constants(),
            .bands = bands(),
            .all_field_points = field_points(),
            .common_pupil = pupil(),
            .ipc_kernel = ipc_kernel()};
}

} // namespace wfpsf::wfirst_afta_c5
