// SPDX-License-Identifier: GPL-3.0-or-later
#include "fits_bytes.hpp"
#include "image/fits.hpp"
#include "status_of.hpp"
#include "temporary_folder.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

using namespace wfpsf;

namespace {

std::string gzipped(const std::string &bytes, const TemporaryFolder &folder) {
    const std::string path = folder.path("gzipped");
    const gzFile file = gzopen(path.c_str(), "wb");
    gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
    gzclose(file);
    return read_text(path);
}

// The file's bytes are refused when they are read plain and compressed.
void expect_refused(const std::string &bytes, const std::string &text) {
    const TemporaryFolder folder;
    const std::string path = folder.path("bad.fits");
    for (const std::string &content : {bytes, gzipped(bytes, folder)}) {
        write_text(path, content);
        try {
            read_fits(path, {0, ""});
            ADD_FAILURE() << "was read, instead of: " << text;
        } catch (const Error &error) {
            EXPECT_EQ(error.status(), WFPSF_ERROR_FILE_FORMAT) << error.what();
            EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
        }
    }
}

std::string with_cards(const std::vector<std::string> &cards) {
    return fits_header(cards) + std::string(2880, '\0');
}

TEST(FitsBadFile, not_fits_at_all) {
    expect_refused("", "not a FITS file");
    expect_refused("SIMPLE", "not a FITS file");
    expect_refused(std::string(5760, 'x'), "not a FITS file");
    expect_refused(with_cards(image_cards(-32, 2, 2, "SIMPLY  =                    T")),
                   "not a FITS file");
}

TEST(FitsBadFile, header_is_cut_or_wrong) {
    expect_refused(fits_header(image_cards(-32, 2, 2)).substr(0, 400), "not a FITS file");
    expect_refused(with_cards(image_cards(7, 2, 2)), "BITPIX = 7");
    expect_refused(with_cards({"SIMPLE  =                    T", "BITPIX  = -32"}),
                   "must be NAXIS");
}

TEST(FitsBadFile, not_two_dimensional) {
    const std::vector<std::string> start = {"SIMPLE  =                    T", "BITPIX  = -32"};
    auto cards = start;
    cards.push_back("NAXIS   = 0");
    expect_refused(with_cards(cards), "NAXIS = 0");
    cards = start;
    cards.insert(cards.end(), {"NAXIS   = 1", "NAXIS1  = 4"});
    expect_refused(with_cards(cards), "NAXIS = 1");
    cards = start;
    cards.insert(cards.end(), {"NAXIS   = 3", "NAXIS1  = 4", "NAXIS2  = 4", "NAXIS3  = 1"});
    expect_refused(with_cards(cards), "NAXIS = 3");
    expect_refused(with_cards(image_cards(-32, 0, 4)), "0 x 4 pixels");
}

TEST(FitsBadFile, pixels_are_missing) {
    const auto header = fits_header(image_cards(-64, 30, 30));
    expect_refused(header + std::string(7199, '\0'), "too short");
    expect_refused(fits_header(image_cards(-64, 100000, 100000)), "too short");
    expect_refused(fits_header(image_cards(8, 4000000000, 4000000000)), "too short");
}

TEST(FitsBadFile, record_is_wrong) {
    for (const char *card : {"WFPSFOVR= 0", "WFPSFOVR= -3", "WFPSFPIX= -0.11", "WFPSFAPP= -1",
                             "WFPSFAPP= 4294967296", "WFPSFPIX= 'text'"}) {
        auto cards = image_cards(8, 2, 2);
        cards.push_back(card);
        expect_refused(with_cards(cards), std::string(card).substr(0, 8));
    }
}

TEST(FitsBadFile, tile_compressed_or_table) {
    auto table = image_cards(8, 8, 1, "XTENSION= 'BINTABLE'");
    table.insert(table.end(), {"PCOUNT  = 0", "GCOUNT  = 1", "TFIELDS = 1", "TFORM1  = '1PB'"});
    const std::string primary = fits_header(
        {"SIMPLE  =                    T", "BITPIX  = 8", "NAXIS   = 0", "EXTEND  = T"});
    const auto status = [&](const std::vector<std::string> &cards) {
        const std::string bytes = primary + with_cards(cards);
        const TemporaryFolder folder;
        write_text(folder.path("a.fits"), bytes);
        return status_of([&] { read_fits(folder.path("a.fits"), {1, ""}); });
    };
    EXPECT_EQ(status(table), WFPSF_ERROR_FILE_FORMAT);
    table.insert(table.end(), {"ZIMAGE  =                    T", "ZBITPIX = 16", "ZNAXIS  = 2",
                               "ZNAXIS1 = 4", "ZNAXIS2 = 4", "ZCMPTYPE= 'RICE_1'"});
    EXPECT_EQ(status(table), WFPSF_ERROR_FILE_FORMAT);
}

TEST(FitsBadFile, cannot_be_opened) {
    const TemporaryFolder folder;
    for (const std::string &path : {folder.path("none.fits"), folder.path(""), std::string(),
                                    std::string("/dev/null"), std::string(5000, 'x')})
        EXPECT_EQ(status_of([&] { read_fits(path); }), WFPSF_ERROR_FILE_OPEN) << path;
    // cfitsio would look for the name with .gz added.
    write_text(folder.path("a.fits.gz"), "x");
    EXPECT_EQ(status_of([&] { read_fits(folder.path("a.fits")); }), WFPSF_ERROR_FILE_OPEN);
}

TEST(FitsBadFile, compressed_file_is_cut_or_damaged) {
    const TemporaryFolder folder;
    std::string bytes = fits_header(image_cards(-32, 30, 30));
    for (int i = 0; i < 3600; ++i)
        bytes += static_cast<char>(i * i >> 3);
    bytes = gzipped(padded(bytes, '\0'), folder);
    const std::string path = folder.path("a.fits.gz");
    write_text(path, bytes);
    EXPECT_EQ(status_of([&] { read_fits(path); }), WFPSF_OK);
    write_text(path, bytes.substr(0, bytes.size() / 2));
    EXPECT_EQ(status_of([&] { read_fits(path); }), WFPSF_ERROR_FILE_FORMAT);
    bytes[bytes.size() / 2] = static_cast<char>(~bytes[bytes.size() / 2]);
    write_text(path, bytes);
    EXPECT_EQ(status_of([&] { read_fits(path); }), WFPSF_ERROR_FILE_FORMAT);
}

// cfitsio's own text is in the line where it is cfitsio that refuses.
TEST(FitsBadFile, scale_is_not_a_number) {
    auto cards = image_cards(8, 2, 2);
    cards.push_back("BSCALE  = 'one'");
    for (int i = 0; i < 100; ++i) // more than cfitsio's stack of messages holds
        expect_refused(with_cards(cards), "cfitsio status");
}

} // namespace
