// SPDX-License-Identifier: GPL-3.0-or-later
#include "fits_bytes.hpp"
#include "image/fits.hpp"
#include "status_of.hpp"
#include "temporary_folder.hpp"

#include <bit>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>

using namespace wfpsf;

namespace {

using Strings = std::vector<std::string>;

template <class T> PixelType type_of() {
    return std::is_same_v<T, float> ? PixelType::float32 : PixelType::float64;
}

std::vector<double> values_of(const Image &image) {
    std::vector<double> values;
    std::visit(
        [&](auto view) {
            for (int64_t y = 0; y < view.ny; ++y)
                for (int64_t x = 0; x < view.nx; ++x)
                    values.push_back(view(x, y));
        },
        image.pixels());
    return values;
}

Image read_bytes(const std::string &bytes, const FitsHdu &hdu = {}) {
    const TemporaryFolder folder;
    write_text(folder.path("a.fits"), bytes);
    return read_fits(folder.path("a.fits"), hdu);
}

template <class T> class RoundTrip : public ::testing::Test {};
using PixelTypes = ::testing::Types<float, double>;
TYPED_TEST_SUITE(RoundTrip, PixelTypes);

TYPED_TEST(RoundTrip, any_size_and_stride) {
    const TemporaryFolder folder;
    const int64_t sizes[][2] = {{1, 1}, {1, 5}, {7, 1}, {3, 5}, {64, 63}, {721, 1}};
    std::vector<TypeParam> memory(20000);
    for (size_t i = 0; i < memory.size(); ++i)
        memory[i] = static_cast<TypeParam>(std::sin(static_cast<double>(i)));
    TypeParam *middle = &memory[10000];
    for (const auto &[nx, ny] : sizes) {
        const int64_t strides[][2] = {{1, nx}, {-1, -nx}, {2, -2 * nx - 1}, {ny, 1}, {-ny, 1}};
        for (const auto &[sx, sy] : strides)
            for (const char *name : {"image.fits", "image.fits.gz"}) {
                const Image image = Image::wrap(type_of<TypeParam>(), middle, nx, ny, sx, sy);
                write_fits(folder.path(name), image, true);
                const Image back = read_fits(folder.path(name));
                EXPECT_EQ(back.type(), image.type());
                EXPECT_EQ(back.nx(), nx);
                EXPECT_EQ(back.ny(), ny);
                EXPECT_EQ(values_of(back), values_of(image)) << nx << " x " << ny;
            }
    }
    EXPECT_EQ(folder.names(), (Strings{"image.fits", "image.fits.gz"}));
}

TYPED_TEST(RoundTrip, every_kind_of_number_keeps_its_bits) {
    using Limits = std::numeric_limits<TypeParam>;
    const TemporaryFolder folder;
    std::vector<TypeParam> values = {Limits::quiet_NaN(),  Limits::infinity(), -Limits::infinity(),
                                     Limits::denorm_min(), TypeParam{0},       -TypeParam{0},
                                     Limits::max(),        Limits::lowest(),   TypeParam{1} / 3};
    const auto n = static_cast<int64_t>(values.size());
    write_fits(folder.path("a.fits"), Image::wrap(type_of<TypeParam>(), values.data(), n, 1, 1, n),
               false);
    Image back = read_fits(folder.path("a.fits"));
    const auto view = std::get<View<TypeParam>>(back.pixels());
    EXPECT_EQ(std::memcmp(view.data, values.data(), sizeof(TypeParam) * values.size()), 0);
}

TEST(FitsWrite, the_bytes_are_those_of_the_standard) {
    const TemporaryFolder folder;
    std::vector<float> values = {1.0f, -2.5f, 3.25f, 0.1f, 1e30f, -1e-30f};
    write_fits(folder.path("a.fits"), Image::wrap(PixelType::float32, values.data(), 3, 2, 1, 3),
               false);
    const std::string bytes = read_text(folder.path("a.fits"));
    ASSERT_EQ(bytes.size(), 2880u * 2);
    EXPECT_EQ(bytes.substr(2880), fits_data(values));
    EXPECT_EQ(bytes.substr(0, 30), "SIMPLE  =                    T");
    EXPECT_EQ(bytes.substr(80, 30), "BITPIX  =                  -32");
    EXPECT_EQ(bytes.substr(240, 30), "NAXIS1  =                    3");
}

TEST(FitsWrite, record_and_keywords_are_kept) {
    const TemporaryFolder folder;
    Image image(PixelType::float64, 4, 4);
    image.set_oversampling(32);
    image.set_pixel_scale_arcsec(0.11);
    image.set_applied(0x80000003u);
    std::vector<FitsKeyword> keywords = {{"FILTER", std::string("J129"), "band"},
                                         {"SCA", int64_t{7}, ""},
                                         {"ALPHA", 0.1 + 0.2, "a comment"},
                                         {"NOTE", std::string("it's"), ""}};
    for (int i = 0; i < 100; ++i)
        keywords.push_back({"KEY" + std::to_string(i), int64_t{i}, ""});
    write_fits(folder.path("a.fits"), image, false, keywords);
    const Image back = read_fits(folder.path("a.fits"));
    EXPECT_EQ(back.oversampling(), 32);
    EXPECT_EQ(back.pixel_scale_arcsec(), 0.11);
    EXPECT_EQ(back.applied(), 0x80000003u);
    const std::string bytes = read_text(folder.path("a.fits"));
    EXPECT_NE(bytes.find("FILTER  = 'J129    '           / band"), std::string::npos);
    EXPECT_NE(bytes.find("ALPHA   =  0.30000000000000004 / a comment"), std::string::npos);
    EXPECT_NE(bytes.find("NOTE    = 'it''s   '"), std::string::npos);
    EXPECT_NE(bytes.find("KEY99   =                   99"), std::string::npos);
}

TEST(FitsWrite, keywords_that_cannot_be_written_are_refused) {
    const TemporaryFolder folder;
    const Image image(PixelType::float32, 2, 2);
    const auto status = [&](const std::string &name, decltype(FitsKeyword::value) value,
                            const std::string &comment = "") {
        return status_of([&] {
            write_fits(folder.path("a.fits"), image, false, {{name, value, comment}});
        });
    };
    for (const char *name :
         {"", "TOOLONGNAME", "lower", "A B", "NAXIS1", "END", "BSCALE", "WFPSFAPP", "COMMENT"})
        EXPECT_EQ(status(name, int64_t{1}), WFPSF_ERROR_ARGUMENT) << name;
    EXPECT_EQ(status("A", std::nan("")), WFPSF_ERROR_NOT_FINITE);
    EXPECT_EQ(status("A", std::string(69, 'x')), WFPSF_ERROR_ARGUMENT);
    EXPECT_EQ(status("A", std::string(35, '\'')), WFPSF_ERROR_ARGUMENT);
    EXPECT_EQ(status("A", std::string("line\nbreak")), WFPSF_ERROR_ARGUMENT);
    EXPECT_EQ(status("A", int64_t{1}, "tab\t"), WFPSF_ERROR_ARGUMENT);
    EXPECT_EQ(folder.names(), Strings{});
}

TEST(FitsWrite, a_file_that_is_there_is_safe) {
    const TemporaryFolder folder;
    const Image image(PixelType::float32, 2, 2);
    write_text(folder.path("a.fits"), "precious");
    EXPECT_EQ(status_of([&] { write_fits(folder.path("a.fits"), image, false); }),
              WFPSF_ERROR_FILE_WRITE);
    EXPECT_EQ(status_of([&] {
                  write_fits(folder.path("a.fits"), image, true, {{"bad", int64_t{1}, ""}});
              }),
              WFPSF_ERROR_ARGUMENT);
    EXPECT_EQ(read_text(folder.path("a.fits")), "precious");
    write_fits(folder.path("a.fits"), image, true);
    EXPECT_EQ(read_fits(folder.path("a.fits")).nx(), 2);
    EXPECT_EQ(folder.names(), Strings{"a.fits"});
}

TEST(FitsWrite, failures_leave_nothing_behind) {
    const TemporaryFolder folder;
    const Image image(PixelType::float32, 2, 2);
    std::filesystem::create_directory(folder.path("folder"));
    for (const char *name : {"folder", "none/a.fits", "folder/", ""}) {
        const std::string path = *name ? folder.path(name) : "";
        EXPECT_EQ(status_of([&] { write_fits(path, image, true); }), WFPSF_ERROR_FILE_WRITE)
            << name;
    }
    EXPECT_EQ(status_of([&] {
                  write_fits(folder.path("a.fits"), Image(PixelType::float32, 0, 2), true);
              }),
              WFPSF_ERROR_SIZE);
    EXPECT_EQ(folder.names(), Strings{"folder"});
    EXPECT_TRUE(std::filesystem::is_empty(folder.path("folder")));
}

TEST(FitsPath, is_literal) {
    const TemporaryFolder folder;
    Image image(PixelType::float32, 3, 2);
    const auto original = std::filesystem::current_path();
    std::filesystem::current_path(folder.path(""));
    Strings names = {"!a.fits", "a.fits[1:2,1:1]", "mem:b",          "| touch made",
                     "~root",   "a.fits+1",        "a.fits(b.fits)", "-"};
    for (const std::string &name : names) {
        write_fits(name, image, false);
        EXPECT_EQ(read_fits(name).nx(), 3) << name;
    }
    std::filesystem::current_path(original);
    std::ranges::sort(names);
    EXPECT_EQ(folder.names(), names);
}

TEST(FitsRead, every_bitpix) {
    const auto read = [](int bitpix, const std::string &data) {
        return read_bytes(fits_header(image_cards(bitpix, 2, 2)) + data);
    };
    EXPECT_EQ(values_of(read(8, fits_data<uint8_t>({0, 1, 200, 255}))),
              (std::vector<double>{0, 1, 200, 255}));
    EXPECT_EQ(values_of(read(16, fits_data<int16_t>({-32768, -1, 7, 32767}))),
              (std::vector<double>{-32768, -1, 7, 32767}));
    EXPECT_EQ(values_of(read(32, fits_data<int32_t>({-2147483647, -1, 7, 2147483647}))),
              (std::vector<double>{-2147483647, -1, 7, 2147483647}));
    EXPECT_EQ(values_of(read(64, fits_data<int64_t>({-4503599627370497, -1, 7, 1}))),
              (std::vector<double>{-4503599627370497, -1, 7, 1}));
    const Image single = read(-32, fits_data<float>({0.5f, -1, 7, 1e30f}));
    EXPECT_EQ(single.type(), PixelType::float32);
    EXPECT_EQ(values_of(single), (std::vector<double>{0.5, -1, 7, 1e30f}));
    const Image twice = read(-64, fits_data<double>({0.1, -1, 7, 1e300}));
    EXPECT_EQ(twice.type(), PixelType::float64);
    EXPECT_EQ(values_of(twice), (std::vector<double>{0.1, -1, 7, 1e300}));
}

TEST(FitsRead, the_type_that_is_asked_for) {
    const std::string bytes = fits_header(image_cards(-64, 1, 1)) + fits_data<double>({0.1});
    const TemporaryFolder folder;
    write_text(folder.path("a.fits"), bytes);
    const Image image = read_fits(folder.path("a.fits"), {}, PixelType::float32);
    EXPECT_EQ(image.type(), PixelType::float32);
    EXPECT_EQ(values_of(image), std::vector<double>{0.1f});
}

TEST(FitsRead, scale_offset_and_blank) {
    auto cards = image_cards(16, 3, 1);
    cards.insert(cards.end(), {"BSCALE  = 0.5", "BZERO   = 100.0", "BLANK   = -9"});
    const auto values = values_of(read_bytes(fits_header(cards) + fits_data<int16_t>({-9, 3, 8})));
    EXPECT_TRUE(std::isnan(values[0]));
    EXPECT_EQ(values[1], 101.5);
    EXPECT_EQ(values[2], 104);

    cards = image_cards(16, 2, 1);
    cards.insert(cards.end(), {"BSCALE  = 1.0", "BZERO   = 32768"}); // unsigned 16-bit pixels
    EXPECT_EQ(values_of(read_bytes(fits_header(cards) + fits_data<int16_t>({-32768, 32767}))),
              (std::vector<double>{0, 65535}));

    cards = image_cards(-32, 2, 1);
    cards.push_back("BSCALE  = 0.1");
    const Image scaled = read_bytes(fits_header(cards) + fits_data<float>({1, 2}));
    EXPECT_EQ(scaled.type(), PixelType::float64);
    EXPECT_DOUBLE_EQ(values_of(scaled)[1], 0.2);
}

TEST(FitsRead, hdu_by_number_and_by_name) {
    auto second = image_cards(-32, 1, 1, "XTENSION= 'IMAGE   '");
    second.insert(second.end(), {"PCOUNT  = 0", "GCOUNT  = 1", "EXTNAME = 'MASK'"});
    const std::string bytes = fits_header({"SIMPLE  =                    T", "BITPIX  = 8",
                                           "NAXIS   = 0", "EXTEND  =                    T"}) +
                              fits_header(second) + fits_data<float>({42});
    EXPECT_EQ(values_of(read_bytes(bytes, {1, ""})), std::vector<double>{42});
    EXPECT_EQ(values_of(read_bytes(bytes, {{}, "MASK"})), std::vector<double>{42});
    EXPECT_EQ(values_of(read_bytes(bytes)), std::vector<double>{42}); // the first image
    EXPECT_EQ(status_of([&] { read_bytes(bytes, {0, ""}); }), WFPSF_ERROR_FILE_FORMAT);
    EXPECT_EQ(status_of([&] { read_bytes(bytes, {2, ""}); }), WFPSF_ERROR_FILE_FORMAT);
    EXPECT_EQ(status_of([&] { read_bytes(bytes, {{}, "NONE"}); }), WFPSF_ERROR_FILE_FORMAT);
    EXPECT_EQ(status_of([&] { read_bytes(bytes, {-1, ""}); }), WFPSF_ERROR_RANGE);
}

} // namespace
