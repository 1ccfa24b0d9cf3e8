// SPDX-License-Identifier: GPL-3.0-or-later
// fuzz_NAME [seconds [seed]]: mutated inputs from a fixed seed until the time is over.
// fuzz_NAME --file PATH: one input again. A crash names the input by the file it was saved to.
#include "fuzz.hpp"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <unistd.h>

namespace {

const char *const crash_file = "fuzz_crash_input";
std::string input;

// Only calls that are safe in a signal handler.
void save_input(int signal) {
    const int file = open(crash_file, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (file >= 0 && write(file, input.data(), input.size()) >= 0) {
        const char text[] = "the input is in fuzz_crash_input\n";
        if (write(STDERR_FILENO, text, sizeof text - 1) < 0)
            _exit(1);
    }
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

void run() {
    LLVMFuzzerTestOneInput(reinterpret_cast<const uint8_t *>(input.data()), input.size());
}

int run_file(const char *path) {
    std::ifstream file(path, std::ios::binary);
    input.assign(std::istreambuf_iterator<char>(file), {});
    run();
    return 0;
}

void change_bytes(std::mt19937_64 &random) {
    for (auto n = random() % 4; n > 0 && !input.empty(); --n) {
        char &byte = input[random() % input.size()];
        byte = random() % 2 ? static_cast<char>(random())
                            : static_cast<char>(byte ^ 1 << random() % 8);
    }
}

} // namespace

int main(int argc, char **argv) {
    if (argc == 3 && std::strcmp(argv[1], "--file") == 0)
        return run_file(argv[2]);
    const double seconds = argc > 1 ? std::atof(argv[1]) : 2;
    std::mt19937_64 random(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
        std::signal(signal, save_input);

    const auto seeds = fuzz_seeds();
    for (const std::string &seed : seeds) {
        input = seed;
        run();
    }
    long inputs = 0;
    const auto start = std::chrono::steady_clock::now();
    const auto elapsed = [start] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    for (; elapsed() < seconds; ++inputs) {
        input = seeds[random() % seeds.size()];
        for (auto n = 1 + random() % 4; n > 0; --n)
            fuzz_mutate(input, seeds, random);
        change_bytes(random);
        run();
    }
    std::printf("%ld inputs in %.1f s\n", inputs, elapsed());
}
