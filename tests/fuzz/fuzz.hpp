// SPDX-License-Identifier: GPL-3.0-or-later
// What a fuzz program gives to the driver.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

// Runs one input. Anything but a clean return is a finding.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

// Valid inputs to start from.
std::vector<std::string> fuzz_seeds();

// Changes an input in a way that knows its format; the driver adds changes of single bytes.
void fuzz_mutate(std::string &input, const std::vector<std::string> &seeds,
                 std::mt19937_64 &random);
