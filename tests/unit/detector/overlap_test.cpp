// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/overlap.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace wfpsf {
namespace {

class Overlap : public testing::Test {
  protected:
    View<double> window(int64_t x, int64_t y, int64_t nx, int64_t ny) {
        return {pixels.data() + y * 10 + x, nx, ny, 1, 10};
    }
    static View<double> turned(View<double> v) {
        return {&v(v.nx - 1, v.ny - 1), v.nx, v.ny, -v.stride_x, -v.stride_y};
    }
    static View<double> transposed(View<double> v) {
        return {v.data, v.ny, v.nx, v.stride_y, v.stride_x};
    }
    std::vector<double> pixels = std::vector<double>(100);
};

TEST_F(Overlap, SamePixels) {
    const View<double> all = window(0, 0, 10, 10);
    EXPECT_TRUE(shares_memory(all, all));
    EXPECT_TRUE(shares_memory(all, turned(all)));
    EXPECT_TRUE(shares_memory(View<const double>(all), transposed(all)));
    EXPECT_TRUE(shares_memory(all, window(9, 9, 1, 1)));
    EXPECT_TRUE(shares_memory(window(0, 0, 5, 5), window(4, 4, 6, 6)));
}

TEST_F(Overlap, PartsOfOneImageThatDoNotMeet) {
    const View<double> left = window(0, 0, 5, 10), right = window(5, 0, 5, 10);
    EXPECT_FALSE(shares_memory(left, right));
    EXPECT_FALSE(shares_memory(turned(left), right));
    EXPECT_FALSE(shares_memory(transposed(left), turned(right)));
    EXPECT_FALSE(shares_memory(window(0, 0, 10, 4), window(0, 4, 10, 6)));
    const View<double> even_rows{pixels.data(), 10, 5, 1, 20}, odd_rows{&pixels[10], 10, 5, 1, 20};
    EXPECT_FALSE(shares_memory(even_rows, odd_rows));
}

TEST_F(Overlap, InterleavedColumnsCountAsShared) {
    const View<double> even{pixels.data(), 5, 10, 2, 10}, odd{&pixels[1], 5, 10, 2, 10};
    EXPECT_TRUE(shares_memory(even, odd));
}

TEST_F(Overlap, EmptyViewsShareNothing) {
    EXPECT_FALSE(shares_memory(window(0, 0, 0, 10), window(0, 0, 10, 10)));
    EXPECT_FALSE(shares_memory(View<double>{}, View<float>{}));
}

TEST_F(Overlap, PixelTypesMayDiffer) {
    float *as_float = reinterpret_cast<float *>(pixels.data());
    EXPECT_TRUE(shares_memory(window(0, 0, 10, 10), View<float>{as_float + 199, 1, 1, 1, 1}));
    EXPECT_FALSE(shares_memory(window(0, 0, 10, 9), View<float>{as_float + 180, 20, 1, 1, 20}));
}

} // namespace
} // namespace wfpsf
