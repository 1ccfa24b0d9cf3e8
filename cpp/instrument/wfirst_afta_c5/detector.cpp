// SPDX-License-Identifier: GPL-3.0-or-later
// The wfirst module of GalSim 1.3.0 has no persistence.
#include "instrument/wfirst_afta_c5/tables.hpp"

namespace wfpsf::wfirst_afta_c5 {

DetectorFigures detector() {
    return {.persistence_linear = {}, .persistence_fermi = {}, .rounds_first = false};
}

} // namespace wfpsf::wfirst_afta_c5
