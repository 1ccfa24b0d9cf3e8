// SPDX-License-Identifier: GPL-3.0-or-later
// The IPC kernel of both the wfirst module of GalSim 1.3.0 and the roman module of GalSim 2.8.4,
// divided by its sum.
#pragma once

#include "instrument/instrument.hpp"

namespace wfpsf {

IpcTaps nominal_ipc_kernel();

} // namespace wfpsf
