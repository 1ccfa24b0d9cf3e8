// SPDX-License-Identifier: GPL-3.0-or-later
// Benchmark cases: each gives its time and its error, and is run in a process of its own so that
// its peak memory is its own too.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace wfpsf::bench {

struct Timing {
    double median_s = 0, min_s = 0;
    int runs = 0;
};

// Runs a body once to warm up and then as often as fits half a second, `least` to 1000 times. A
// single run is not warmed up.
Timing time(const std::function<void()> &body, int least = 3);

struct Measured {
    Timing timing;
    double error = 0;      // NaN: none is defined
    double baseline_s = 0; // of what it is compared with, in the same run; 0: nothing
    std::string baseline = {};
};

struct Case {
    std::string name, error_kind;
    double target_time_s, target_error; // 0: none set
    std::function<Measured()> run;
};

std::vector<Case> psf_cases();
std::vector<Case> wide_psf_cases();
std::vector<Case> far_light_cases();
std::vector<Case> varying_psf_cases();
std::vector<Case> transform_cases();
std::vector<Case> ipc_cases();
std::vector<Case> moments_cases();
std::vector<Case> study_cases();
std::vector<Case> observation_cases();
std::vector<Case> scene_cases();
std::vector<Case> galaxy_cases();
std::vector<Case> roofline_cases();

} // namespace wfpsf::bench
