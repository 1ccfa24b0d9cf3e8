// SPDX-License-Identifier: GPL-3.0-or-later
// bench [FILE [PART]]: runs every case whose name holds PART, prints speed beside error as a table,
// and writes the same as JSON to FILE (default bench.json). Never fails on a time.
#include "harness.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <wfpsf/version.h>

namespace wfpsf::bench {

Timing time(const std::function<void()> &body, int least) {
    using Clock = std::chrono::steady_clock;
    const auto run = [&body] {
        const auto start = Clock::now();
        body();
        return std::chrono::duration<double>(Clock::now() - start).count();
    };
    if (least > 1)
        run();
    std::vector<double> times;
    double total = 0;
    while (times.size() < static_cast<size_t>(least) || (total < 0.5 && times.size() < 1000)) {
        times.push_back(run());
        total += times.back();
    }
    std::sort(times.begin(), times.end());
    return {times[times.size() / 2], times.front(), static_cast<int>(times.size())};
}

namespace {

struct Row {
    Timing timing;
    double error, baseline_s;
    char baseline[64];
    long memory_kib;
};

// A child runs the case and sends its row; the system tells its peak memory.
bool run_apart(const Case &c, Row &row) {
    int ends[2];
    if (pipe(ends) != 0)
        return false;
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        const Measured m = c.run();
        Row sent{m.timing, m.error, m.baseline_s, {}, 0};
        std::strncpy(sent.baseline, m.baseline.c_str(), sizeof sent.baseline - 1);
        _exit(write(ends[1], &sent, sizeof sent) == sizeof sent ? 0 : 1);
    }
    close(ends[1]);
    const bool received = read(ends[0], &row, sizeof row) == sizeof row;
    close(ends[0]);
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    row.memory_kib = usage.ru_maxrss;
    return received && status == 0;
}

std::string number(double value) {
    if (!std::isfinite(value))
        return "null";
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

std::string machine() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name"))
            return line.substr(line.find(':') + 2);
    return "unknown";
}

std::string today() {
    const std::time_t now = std::time(nullptr);
    char text[16];
    std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&now));
    return text;
}

} // namespace

} // namespace wfpsf::bench

int main(int argc, char **argv) {
    using namespace wfpsf::bench;
    std::vector<Case> cases = psf_cases();
    for (auto more : {wide_psf_cases(), far_light_cases(), varying_psf_cases(), transform_cases(),
                      ipc_cases(), moments_cases(), study_cases(), observation_cases(),
                      galaxy_cases(), scene_cases(), roofline_cases()})
        cases.insert(cases.end(), more.begin(), more.end());

    if (argc > 2)
        std::erase_if(cases,
                      [&](const Case &c) { return c.name.find(argv[2]) == std::string::npos; });
    std::ofstream json(argc > 1 ? argv[1] : "bench.json");
    json << "{\"machine\": \"" << machine() << "\", \"version\": \"" << wfpsf_version()
         << "\", \"date\": \"" << today() << "\", \"cases\": [";
    std::printf("%s, wfpsf %s, one thread\n\n", machine().c_str(), wfpsf_version());
    std::printf("%-68s %10s %10s %9s %9s %8s  %s\n", "case", "median", "target", "error", "target",
                "MiB", "against");
    bool all_ran = true;
    const char *separator = "";
    for (const Case &c : cases) {
        Row row{};
        if (!run_apart(c, row)) {
            std::printf("%-68s failed\n", c.name.c_str());
            all_ran = false;
            continue;
        }
        const double ratio = row.baseline_s > 0 ? row.timing.median_s / row.baseline_s : NAN;
        char against[96] = "";
        if (row.baseline_s > 0)
            std::snprintf(against, sizeof against, "%.3g x %s", ratio, row.baseline);
        const auto milliseconds = [](double s) {
            char text[24] = "";
            if (s > 0)
                std::snprintf(text, sizeof text, "%.4g ms", 1e3 * s);
            return std::string(text);
        };
        std::printf("%-68s %10s %10s %9.1e %9s %8.0f  %s\n", c.name.c_str(),
                    milliseconds(row.timing.median_s).c_str(),
                    milliseconds(c.target_time_s).c_str(), row.error,
                    c.target_error > 0 ? number(c.target_error).c_str() : "",
                    static_cast<double>(row.memory_kib) / 1024, against);
        json << separator << "\n  {\"case\": \"" << c.name
             << "\", \"time_s\": " << number(row.timing.median_s)
             << ", \"time_min_s\": " << number(row.timing.min_s)
             << ", \"runs\": " << row.timing.runs << ", \"error\": " << number(row.error)
             << ", \"error_kind\": \"" << c.error_kind
             << "\", \"memory_bytes\": " << row.memory_kib * 1024
             << ", \"target_time_s\": " << (c.target_time_s > 0 ? number(c.target_time_s) : "null")
             << ", \"target_error\": " << (c.target_error > 0 ? number(c.target_error) : "null");
        if (row.baseline_s > 0)
            json << ", \"baseline\": {\"name\": \"" << row.baseline
                 << "\", \"time_s\": " << number(row.baseline_s)
                 << "}, \"ratio\": " << number(ratio) << "}";
        else
            json << ", \"baseline\": null, \"ratio\": null}";
        separator = ",";
    }
    json << "\n]}\n";
    return all_ran ? 0 : 1;
}
