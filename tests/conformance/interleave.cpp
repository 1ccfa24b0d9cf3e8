// SPDX-License-Identifier: GPL-3.0-or-later
// Interleaved images of GalSim, whose offsets move the object; exact. And the identity that makes
// one pass over an oversampled image the same as IPC in every dithered native one.
#include "csv.hpp"
#include "handles.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace {

struct Case {
    int n_x = 0, n_y = 0, nx = 0, ny = 0;
    std::vector<double> dx, dy;
    std::vector<Pixels> images;
    std::vector<const wfpsf_image *> handles() const {
        std::vector<const wfpsf_image *> list;
        for (const Pixels &image : images)
            list.push_back(image.image.get());
        return list;
    }
    std::vector<wfpsf_image *> outputs() const {
        std::vector<wfpsf_image *> list;
        for (const Pixels &image : images)
            list.push_back(image.image.get());
        return list;
    }
};

std::map<std::string, Case> cases() {
    std::map<std::string, Case> all;
    const Table table("interleave_in.csv");
    for (const Row &row : table) {
        Case &c = all[row.text("case")];
        c.n_x = row.integer("N1");
        c.n_y = row.integer("N2");
        c.nx = std::max(c.nx, row.integer("ix") + 1);
        c.ny = std::max(c.ny, row.integer("iy") + 1);
    }
    for (const Row &row : table) {
        Case &c = all[row.text("case")];
        if (row.integer("k") == static_cast<int>(c.images.size())) {
            c.images.emplace_back(c.nx, c.ny);
            c.dx.push_back(row.number("dx"));
            c.dy.push_back(row.number("dy"));
        }
        c.images[static_cast<size_t>(row.integer("k"))](row.integer("ix"), row.integer("iy")) =
            row.number("value");
    }
    return all;
}

TEST(Interleave, ThereAndBack) {
    const Table expected("interleave_out.csv");
    for (auto &[name, c] : cases()) {
        SCOPED_TRACE(name);
        Pixels fine(c.n_x * c.nx, c.n_y * c.ny);
        require(wfpsf_image_interleave(c.n_x, c.n_y, c.handles().data(), c.dx.data(), c.dy.data(),
                                       WFPSF_DITHER_OBJECT, fine.image.get()));
        size_t compared = 0;
        for (const Row &row : expected)
            if (row.text("case") == name) {
                EXPECT_EQ(fine(row.integer("ix"), row.integer("iy")), row.number("value"));
                ++compared;
            }
        EXPECT_EQ(compared, fine.data.size());

        std::vector<std::vector<double>> before;
        for (Pixels &image : c.images) {
            before.push_back(image.data);
            std::fill(image.data.begin(), image.data.end(), 0);
        }
        require(wfpsf_image_deinterleave(fine.image.get(), c.n_x, c.n_y, c.dx.data(), c.dy.data(),
                                         WFPSF_DITHER_OBJECT, c.outputs().data()));
        for (size_t k = 0; k < before.size(); ++k)
            EXPECT_EQ(c.images[k].data, before[k]);
    }
}

TEST(Interleave, IpcOnceOrInEveryDither) {
    constexpr int n = 4, nx = 13, ny = 11;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> value(-1, 1000);
    const Kernel kernel = make_kernel(0.02, 0.002, 0.003);
    for (int32_t edge : {WFPSF_EDGE_ZERO, WFPSF_EDGE_REPLICATE, WFPSF_EDGE_WRAP, WFPSF_EDGE_CROP}) {
        SCOPED_TRACE(edge);
        Case native;
        std::vector<Pixels> blurred;
        for (int k = 0; k < n * n; ++k) {
            native.images.emplace_back(nx, ny);
            const int i = k % n, j = k / n;
            native.dx.push_back(i / double{n});
            native.dy.push_back(j / double{n});
            for (double &pixel : native.images.back().data)
                pixel = value(random);
            blurred.emplace_back(nx, ny);
            require(wfpsf_ipc_apply(kernel.get(), native.images.back().image.get(), edge, nullptr,
                                    blurred.back().image.get(), NULL));
        }
        Pixels fine(n * nx, n * ny), once(n * nx, n * ny), each(n * nx, n * ny);
        require(wfpsf_image_interleave(n, n, native.handles().data(), native.dx.data(),
                                       native.dy.data(), WFPSF_DITHER_DETECTOR, fine.image.get()));
        require(
            wfpsf_ipc_apply(kernel.get(), fine.image.get(), edge, nullptr, once.image.get(), NULL));
        native.images = std::move(blurred);
        require(wfpsf_image_interleave(n, n, native.handles().data(), native.dx.data(),
                                       native.dy.data(), WFPSF_DITHER_DETECTOR, each.image.get()));
        for (size_t i = 0; i < once.data.size(); ++i)
            EXPECT_NEAR(once.data[i], each.data[i], 1000 * 1e-15);
    }
}

} // namespace
