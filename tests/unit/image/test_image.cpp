// SPDX-License-Identifier: GPL-3.0-or-later
#include "error/error.hpp"
#include "image/image.hpp"
#include "status_of.hpp"

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <set>
#include <utility>
#include <vector>

using namespace wfpsf;

namespace {

constexpr int64_t huge = std::numeric_limits<int64_t>::max();

TEST(Image, owned_pixels_are_zeroed_and_contiguous) {
    Image image(PixelType::float32, 5, 3);
    EXPECT_EQ(image.type(), PixelType::float32);
    const auto view = std::get<View<float>>(image.pixels());
    EXPECT_EQ(view.nx, 5);
    EXPECT_EQ(view.ny, 3);
    EXPECT_EQ(view.stride_x, 1);
    EXPECT_EQ(view.stride_y, 5);
    for (int i = 0; i < 15; ++i)
        EXPECT_EQ(view.data[i], 0.0f);
}

TEST(Image, moving_keeps_pixels_and_record) {
    Image image(PixelType::float64, 2, 2);
    std::get<View<double>>(image.pixels())(1, 1) = 4;
    image.set_oversampling(32);
    image.record_applied(Effect::ipc);
    const Image moved = std::move(image);
    EXPECT_EQ(std::get<View<const double>>(moved.pixels())(1, 1), 4);
    EXPECT_EQ(moved.oversampling(), 32);
    EXPECT_TRUE(moved.is_applied(Effect::ipc));
}

TEST(Image, wrapped_pixels_are_the_callers) {
    std::vector<double> memory(12);
    Image image = Image::wrap(PixelType::float64, &memory[11], 4, 3, -1, -4);
    std::get<View<double>>(image.pixels())(1, 2) = 7;
    EXPECT_EQ(memory[2], 7);
}

TEST(Image, may_be_empty) {
    EXPECT_EQ(Image(PixelType::float32, 0, 0).nx(), 0);
    EXPECT_EQ(Image(PixelType::float64, 0, 7).ny(), 7);
    EXPECT_EQ(Image(PixelType::float64, huge, 0).nx(), huge);
    EXPECT_EQ(Image::wrap(PixelType::float64, nullptr, 0, 0, 0, 0).ny(), 0);
}

TEST(Image, sizes_out_of_range_are_refused) {
    const auto make = [](int64_t nx, int64_t ny) {
        return status_of([&] { Image(PixelType::float64, nx, ny); });
    };
    EXPECT_EQ(make(-1, 4), WFPSF_ERROR_SIZE);
    EXPECT_EQ(make(4, -1), WFPSF_ERROR_SIZE);
    EXPECT_EQ(make(huge, 2), WFPSF_ERROR_SIZE);
    EXPECT_EQ(make(huge / 8 + 1, 1), WFPSF_ERROR_SIZE);
}

TEST(Image, bad_memory_is_refused) {
    std::vector<double> memory(12);
    const auto wrap = [&](void *data) {
        return status_of([&] { Image::wrap(PixelType::float64, data, 4, 3, 1, 4); });
    };
    EXPECT_EQ(wrap(memory.data()), WFPSF_OK);
    EXPECT_EQ(wrap(nullptr), WFPSF_ERROR_NULL);
    EXPECT_EQ(wrap(reinterpret_cast<char *>(memory.data()) + 4), WFPSF_ERROR_ARGUMENT);
}

// Every pair of strides in a box, against the set of addresses it makes.
TEST(Image, strides_are_refused_exactly_when_pixels_share_memory) {
    std::vector<float> memory(400);
    for (int64_t nx = 1; nx <= 4; ++nx)
        for (int64_t ny = 1; ny <= 4; ++ny)
            for (int64_t sx = -7; sx <= 7; ++sx)
                for (int64_t sy = -7; sy <= 7; ++sy) {
                    std::set<int64_t> addresses;
                    for (int64_t y = 0; y < ny; ++y)
                        for (int64_t x = 0; x < nx; ++x)
                            addresses.insert(y * sy + x * sx);
                    const bool apart = static_cast<int64_t>(addresses.size()) == nx * ny;
                    const wfpsf_status status = status_of(
                        [&] { Image::wrap(PixelType::float32, &memory[200], nx, ny, sx, sy); });
                    EXPECT_EQ(status, apart ? WFPSF_OK : WFPSF_ERROR_SIZE)
                        << nx << " x " << ny << ", strides " << sx << ", " << sy;
                }
}

TEST(Image, strides_that_overflow_are_refused) {
    double pixel = 0;
    const int64_t lowest = std::numeric_limits<int64_t>::min();
    const auto wrap = [&](int64_t nx, int64_t ny, int64_t sx, int64_t sy) {
        return status_of([&] { Image::wrap(PixelType::float64, &pixel, nx, ny, sx, sy); });
    };
    EXPECT_EQ(wrap(2, 2, huge, 1), WFPSF_ERROR_SIZE);
    EXPECT_EQ(wrap(2, 2, 1, lowest), WFPSF_ERROR_SIZE);
    EXPECT_EQ(wrap(1, 1, lowest, 1), WFPSF_ERROR_SIZE);
    EXPECT_EQ(wrap(1, 1 << 20, 1, huge / 1024), WFPSF_ERROR_SIZE);
    EXPECT_EQ(wrap(1, 1, 0, 0), WFPSF_OK);
}

TEST(Image, record_is_checked) {
    Image image(PixelType::float32, 1, 1);
    EXPECT_EQ(image.oversampling(), 1);
    EXPECT_EQ(image.pixel_scale_arcsec(), 0);
    EXPECT_EQ(status_of([&] { image.set_oversampling(0); }), WFPSF_ERROR_RANGE);
    EXPECT_EQ(status_of([&] { image.set_pixel_scale_arcsec(-0.11); }), WFPSF_ERROR_RANGE);
    EXPECT_EQ(status_of([&] { image.set_pixel_scale_arcsec(std::nan("")); }),
              WFPSF_ERROR_NOT_FINITE);
}

TEST(Image, effect_is_applied_once_unless_forced) {
    Image image(PixelType::float32, 1, 1);
    EXPECT_EQ(status_of([&] { image.require_not_applied(Effect::ipc, false); }), WFPSF_OK);
    image.record_applied(Effect::ipc);
    EXPECT_EQ(status_of([&] { image.require_not_applied(Effect::ipc, false); }),
              WFPSF_ERROR_ALREADY_APPLIED);
    EXPECT_EQ(status_of([&] { image.require_not_applied(Effect::ipc, true); }), WFPSF_OK);
    EXPECT_EQ(status_of([&] { image.require_not_applied(Effect::pixel_response, false); }),
              WFPSF_OK);
}

} // namespace
