// SPDX-License-Identifier: GPL-3.0-or-later
// What one core of this machine can do at most: move bytes through memory, and multiply and add in
// registers. docs/speed.py holds the hot paths against it.
#include "harness.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

namespace wfpsf::bench {

namespace {

constexpr size_t copied = size_t{4088} * 4088;

// Other compilers leave the arithmetic out.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define WITH_ARITHMETIC

constexpr int64_t steps = 1'000'000;
constexpr size_t chains = 12; // hide the latency, and fit in 16 registers

template <int lanes> struct Vector { typedef double type __attribute__((vector_size(8 * lanes))); };

// Keeps a step from being folded into another.
template <class Lanes> [[gnu::always_inline]] inline void take(Lanes &x) {
    asm("" : "+x"(x));
}

// x = a x + b in independent chains of vectors, which all tend to b / (1 - a). Returns how far off
// that they end.
template <int lanes, size_t... chain>
[[gnu::always_inline]] inline double multiply_and_add(std::index_sequence<chain...>) {
    using Lanes = typename Vector<lanes>::type;
    constexpr double factor = 0.75, addend = 0.5;
    const Lanes a = Lanes{} + factor, b = Lanes{} + addend;
    Lanes x[] = {Lanes{} + static_cast<double>(chain)...};
    for (int64_t i = 0; i < steps; ++i)
        (take(x[chain] = a * x[chain] + b), ...);
    const Lanes mean = (x[chain] + ...) / static_cast<double>(sizeof...(chain));
    double worst = 0;
    for (int l = 0; l < lanes; ++l)
        worst = std::max(worst, std::abs(mean[l] - addend / (1 - factor)));
    return worst;
}

__attribute__((target("avx2,fma"))) double with_avx2() {
    return multiply_and_add<4>(std::make_index_sequence<chains>());
}
__attribute__((target("avx512f"))) double with_avx512() {
    return multiply_and_add<8>(std::make_index_sequence<chains>());
}

// The name tells how many operations it takes.
Case arithmetic_case(int lanes, double (*run)()) {
    char name[96];
    std::snprintf(name, sizeof name, "peak: %lld operations on vectors of %d doubles",
                  static_cast<long long>(2 * steps * static_cast<int64_t>(chains) * lanes), lanes);
    return {name, "from the limit", 0, 1e-15, [run] {
                Measured m;
                m.timing = time([run] { run(); });
                m.error = run();
                return m;
            }};
}

#endif

Case memory_case() {
    char name[96];
    std::snprintf(name, sizeof name, "peak: %lld bytes through memory, half read, half written",
                  static_cast<long long>(2 * copied * sizeof(double)));
    return {name, "none", 0, 0, [] {
                const std::vector<double> from(copied, 1.0);
                std::vector<double> to(copied);
                Measured m;
                m.timing =
                    time([&] { std::memcpy(to.data(), from.data(), copied * sizeof(double)); }, 10);
                m.error = NAN;
                return m;
            }};
}

} // namespace

std::vector<Case> roofline_cases() {
    std::vector<Case> cases{memory_case()};
#ifdef WITH_ARITHMETIC
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        cases.push_back(arithmetic_case(4, with_avx2));
    if (__builtin_cpu_supports("avx512f"))
        cases.push_back(arithmetic_case(8, with_avx512));
#endif
    return cases;
}

} // namespace wfpsf::bench
