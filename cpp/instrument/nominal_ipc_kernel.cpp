// SPDX-License-Identifier: GPL-3.0-or-later
// Published as a correlation, K(dx, dy) weighing the neighbour at (x + dx, y + dy); here it stands
// turned by 180 degrees, as the convolution's kernel.
#include "instrument/nominal_ipc_kernel.hpp"

namespace wfpsf {

IpcTaps nominal_ipc_kernel() {
    return {
        // clang-format off
        0.0011259691138377536, 0.015132816346775905, 0.0011918814506156027, // dy = -1
        0.014636271864406926, 0.9382004836429121, 0.012947332735757792, // dy = 0
        0.001125711108704752, 0.01444807729119251, 0.0011914564457965124, // dy = +1
        // clang-format on
    };
}

} // namespace wfpsf
