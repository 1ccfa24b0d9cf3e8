// SPDX-License-Identifier: GPL-3.0-or-later
// IPC against GalSim's applyIPC, which is a correlation: it is given the flipped kernel here.
#include "csv.hpp"
#include "handles.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace {

constexpr double tolerance = 1e-14; // of the largest pixel

double largest(const std::vector<double> &pixels) {
    double most = 0;
    for (const double pixel : pixels)
        most = std::max(most, std::abs(pixel));
    return most;
}

// Kernels by name, as convolutions that correlate with the tabulated taps.
std::map<std::string, Kernel> correlations() {
    std::map<std::string, std::array<double, 9>> taps;
    for (const Row &row : Table("ipc_kernels.csv")) {
        const int x = row.integer("dx") + 1, y = row.integer("dy") + 1;
        taps[row.text("kernel")][static_cast<size_t>(3 * y + x)] = row.number("used");
    }
    const Options options = make_options();
    require(wfpsf_options_set_integer(options.get(), WFPSF_OPTION_KERNEL_NEGATIVE, 1));
    std::map<std::string, Kernel> kernels;
    for (const auto &[name, table] : taps) {
        wfpsf_ipc_kernel *kernel = nullptr, *flipped = nullptr;
        require(wfpsf_ipc_kernel_create_taps(3, 3, table.data(), options.get(), &kernel));
        const Kernel convolution(kernel);
        require(wfpsf_ipc_kernel_create_flipped(kernel, &flipped));
        kernels[name].reset(flipped);
    }
    return kernels;
}

struct Case {
    std::string kernel, edge, fill;
    int nx = 0, ny = 0;
    std::vector<Row> rows;
};

int32_t edge_of(const Case &c) {
    if (c.edge == "extend")
        return WFPSF_EDGE_ZERO;
    if (c.edge == "wrap")
        return WFPSF_EDGE_WRAP;
    return c.fill.empty() ? WFPSF_EDGE_CROP : WFPSF_EDGE_FILL;
}

TEST(Ipc, Cases) {
    const std::map<std::string, Kernel> kernels = correlations();
    const Table table("ipc_cases.csv");
    std::map<int, Case> cases;
    for (const Row &row : table) {
        Case &c = cases[row.integer("case")];
        c.kernel = row.text("kernel");
        c.edge = row.text("edge");
        c.fill = row.text("fill");
        c.nx = std::max(c.nx, row.integer("ix") + 1);
        c.ny = std::max(c.ny, row.integer("iy") + 1);
        c.rows.push_back(row);
    }
    EXPECT_EQ(cases.size(), 112u);
    for (const auto &[number, c] : cases) {
        SCOPED_TRACE("case " + std::to_string(number) + ", kernel " + c.kernel + ", " + c.edge);
        Pixels in(c.nx, c.ny), out(c.nx, c.ny);
        for (const Row &row : c.rows)
            in(row.integer("ix"), row.integer("iy")) = row.number("in");
        const Options options = make_options();
        if (!c.fill.empty())
            require(
                wfpsf_options_set_real(options.get(), WFPSF_OPTION_IPC_FILL, std::stod(c.fill)));
        require(wfpsf_ipc_apply(kernels.at(c.kernel).get(), in.image.get(), edge_of(c),
                                options.get(), out.image.get(), NULL));
        for (const Row &row : c.rows)
            EXPECT_NEAR(out(row.integer("ix"), row.integer("iy")), row.number("out"),
                        tolerance * largest(in.data))
                << row.text("ix") << " " << row.text("iy");
    }
}

// The kernels that the library makes itself.
TEST(Ipc, ReadyMadeKernels) {
    const Instrument c5 = make_c5();
    std::map<std::string, Kernel> kernels;
    kernels["K1"] = make_kernel(0.02, 0, 0);
    kernels["K2"] = make_kernel(0.02, 0.002, 0);
    kernels["K3"] = make_kernel(0.02, 0.002, 0.002);
    wfpsf_ipc_kernel *kernel = nullptr, *flipped = nullptr;
    require(wfpsf_ipc_kernel_create_wfc3(&kernel));
    kernels["WFC3"].reset(kernel);
    require(wfpsf_ipc_kernel_create_correction(kernels["K3"].get(), &kernel));
    kernels["K3CORR"].reset(kernel);
    // The default is tabulated for a correlation and handed out as a convolution.
    require(wfpsf_ipc_kernel_create_default(c5.get(), &kernel));
    const Kernel convolution(kernel);
    require(wfpsf_ipc_kernel_create_flipped(kernel, &flipped));
    kernels["DEFAULT"].reset(flipped);
    for (const Row &row : Table("ipc_kernels.csv")) {
        const auto found = kernels.find(row.text("kernel"));
        if (found == kernels.end())
            continue;
        std::array<double, 9> taps{};
        require(wfpsf_ipc_kernel_taps(found->second.get(), 9, taps.data(), nullptr, nullptr));
        const int x = row.integer("dx") + 1, y = row.integer("dy") + 1;
        EXPECT_NEAR(taps[static_cast<size_t>(3 * y + x)], row.number("used"), 1e-15)
            << row.text("kernel") << " " << row.text("dx") << " " << row.text("dy");
    }
}

TEST(Ipc, Correction) {
    const Table table("ipc_correction.csv");
    constexpr int size = 11;
    for (const std::array<double, 3> &p :
         {std::array{0.02, 0.0, 0.0}, {0.02, 0.0, 0.002}, {0.02, 0.002, 0.002}}) {
        Pixels in(size, size), blurred(size, size), corrected(size, size);
        for (const Row &row : table)
            if (row.number("in") != 0)
                in(row.integer("ix"), row.integer("iy")) = row.number("in");
        const Kernel kernel = make_kernel(p[0], p[2], p[1]);
        wfpsf_ipc_kernel *correction = nullptr;
        require(wfpsf_ipc_kernel_create_correction(kernel.get(), &correction));
        const Kernel owner(correction);
        require(wfpsf_ipc_apply(kernel.get(), in.image.get(), WFPSF_EDGE_ZERO, nullptr,
                                blurred.image.get(), NULL));
        require(wfpsf_ipc_apply(correction, blurred.image.get(), WFPSF_EDGE_ZERO, nullptr,
                                corrected.image.get(), NULL));
        int compared = 0;
        for (const Row &row : table) {
            if (row.number("alpha") != p[0] || row.number("alpha_plus") != p[1] ||
                row.number("alpha_prime") != p[2])
                continue;
            const int x = row.integer("ix"), y = row.integer("iy");
            EXPECT_NEAR(blurred(x, y), row.number("after_ipc"), tolerance * 1000);
            EXPECT_NEAR(corrected(x, y), row.number("after_correction"), tolerance * 1000);
            ++compared;
        }
        EXPECT_GE(compared, 13);
    }
}

} // namespace
