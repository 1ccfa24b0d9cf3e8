// SPDX-License-Identifier: GPL-3.0-or-later
// Persistence, as in the roman module of GalSim 2.8.4.
#include "instrument/roman_c9/tables.hpp"

namespace wfpsf::roman_c9 {
namespace {

constexpr double linear[] = {
    0.00045707683, 0.00014959817999999999, 9.115737000000001e-05, 6.567690000000001e-05,
    5.135571e-05,  4.2170280000000004e-05, 3.577534e-05,          3.106601e-05};

// A (e-/s), x0 (e-), dx (e-), a, r, half_well (e-)
constexpr double fermi[] = {0.017, 60000.0, 50000.0, 0.045, 1.0, 50000.0};

} // namespace

DetectorFigures detector() {
    return {.persistence_linear = linear, .persistence_fermi = fermi, .rounds_first = true};
}

} // namespace wfpsf::roman_c9
