// SPDX-License-Identifier: GPL-3.0-or-later
// The FITS reader on damaged files. An Error is the right answer; what is read must be consistent.
#include "error/error.hpp"
#include "fuzz.hpp"
#include "image/fits.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace {

constexpr size_t card_bytes = 80, block_bytes = 2880;

std::string header(const std::vector<std::string> &cards) {
    std::string text;
    for (std::string card : cards) {
        card.resize(card_bytes, ' ');
        text += card;
    }
    text += "END";
    text.resize((text.size() + block_bytes - 1) / block_bytes * block_bytes, ' ');
    return text;
}

std::string data(size_t bytes) {
    std::string text((bytes + block_bytes - 1) / block_bytes * block_bytes, '\0');
    for (size_t i = 0; i < bytes; ++i)
        text[i] = static_cast<char>(i * 37);
    return text;
}

std::vector<std::string> image_cards(const char *first, int bitpix) {
    return {first, "BITPIX  = " + std::to_string(bitpix), "NAXIS   = 2", "NAXIS1  = 5",
            "NAXIS2  = 7"};
}

void change_card(std::string &input, std::mt19937_64 &random) {
    static const char *const values[] = {"0",
                                         "-1",
                                         "1",
                                         "2",
                                         "3",
                                         "999",
                                         "8",
                                         "16",
                                         "-32",
                                         "-64",
                                         "7",
                                         "2147483647",
                                         "2147483648",
                                         "4294967296",
                                         "9223372036854775807",
                                         "-9223372036854775808",
                                         "99999999999999999999",
                                         "1e308",
                                         "1e999",
                                         "NaN",
                                         "T",
                                         "F",
                                         "'",
                                         "'x'",
                                         "'IMAGE   '",
                                         "'BINTABLE'",
                                         "'TABLE   '",
                                         "'RICE_1  '",
                                         "'1PB(999999)'",
                                         "'1E'",
                                         "(1,2)",
                                         ""};
    static const char *const names[] = {
        "SIMPLE  ", "XTENSION", "BITPIX  ", "NAXIS   ", "NAXIS1  ", "NAXIS2  ", "NAXIS3  ",
        "NAXIS999", "PCOUNT  ", "GCOUNT  ", "GROUPS  ", "EXTEND  ", "EXTNAME ", "HDUNAME ",
        "BSCALE  ", "BZERO   ", "BLANK   ", "TFIELDS ", "TFORM1  ", "TBCOL1  ", "THEAP   ",
        "ZIMAGE  ", "ZCMPTYPE", "ZBITPIX ", "ZNAXIS  ", "ZNAXIS1 ", "ZTILE1  ", "WFPSFOVR",
        "WFPSFPIX", "WFPSFAPP", "CONTINUE", "HIERARCH", "COMMENT ", "END     ", "LONGSTRN"};
    if (input.size() < card_bytes)
        return;
    const size_t start = random() % (input.size() / card_bytes) * card_bytes;
    const bool keep_name = random() % 2;
    std::string card = keep_name ? input.substr(start, 8) : names[random() % std::size(names)];
    card += std::string("= ") + values[random() % std::size(values)];
    card.resize(card_bytes, ' ');
    if (random() % 4 == 0)
        input.insert(start, card);
    else
        input.replace(start, card_bytes, card);
}

void cut(std::string &input, std::mt19937_64 &random) {
    const size_t unit = random() % 2 ? 1 : card_bytes;
    input.resize(random() % (input.size() / unit + 1) * unit);
}

void splice(std::string &input, const std::string &other, std::mt19937_64 &random) {
    const size_t unit = random() % 2 ? block_bytes : card_bytes;
    const size_t here = random() % (input.size() / unit + 1) * unit;
    const size_t there = random() % (other.size() / unit + 1) * unit;
    input = input.substr(0, here) + other.substr(there);
}

} // namespace

std::vector<std::string> fuzz_seeds() {
    std::vector<std::string> seeds;
    for (const int bitpix : {8, 16, 32, 64, -32, -64})
        seeds.push_back(header(image_cards("SIMPLE  =                    T", bitpix)) +
                        data(35 * 8));
    auto cards = image_cards("SIMPLE  =                    T", 16);
    cards.insert(cards.end(), {"BSCALE  = 0.5", "BZERO   = 32768", "BLANK   = 7", "WFPSFOVR= 32",
                               "WFPSFPIX= 0.11", "WFPSFAPP= 3"});
    seeds.push_back(header(cards) + data(70));
    const std::string primary = header({"SIMPLE  =                    T", "BITPIX  = 8",
                                        "NAXIS   = 0", "EXTEND  =                    T"});
    cards = image_cards("XTENSION= 'IMAGE   '", -32);
    cards.insert(cards.end(), {"PCOUNT  = 0", "GCOUNT  = 1", "EXTNAME = 'MASK    '"});
    seeds.push_back(primary + header(cards) + data(140));
    cards = image_cards("XTENSION= 'BINTABLE'", 8);
    cards.insert(cards.end(),
                 {"PCOUNT  = 64", "GCOUNT  = 1", "TFIELDS = 1", "TFORM1  = '1PB(5)'",
                  "ZIMAGE  =                    T", "ZBITPIX = 16", "ZNAXIS  = 2", "ZNAXIS1 = 5",
                  "ZNAXIS2 = 7", "ZCMPTYPE= 'RICE_1  '", "ZTILE1  = 5", "ZTILE2  = 1"});
    seeds.push_back(primary + header(cards) + data(99));
    return seeds;
}

void fuzz_mutate(std::string &input, const std::vector<std::string> &seeds,
                 std::mt19937_64 &random) {
    switch (random() % 8) {
    case 0:
        return cut(input, random);
    case 1:
        return splice(input, seeds[random() % seeds.size()], random);
    default:
        return change_card(input, random);
    }
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size) {
    static const std::string path = std::filesystem::temp_directory_path() /
                                    ("wfpsf-fuzz-" + std::to_string(getpid()) + ".fits");
    struct Remove {
        ~Remove() { std::remove(path.c_str()); }
    } remove;
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char *>(bytes), static_cast<std::streamsize>(size));
    const wfpsf::FitsHdu hdus[] = {{}, {0, ""}, {1, ""}, {2, ""}, {{}, "MASK"}};
    for (const auto &hdu : hdus) {
        try {
            const wfpsf::Image image = wfpsf::read_fits(path, hdu);
            if (image.nx() < 1 || image.ny() < 1 || image.oversampling() < 1)
                std::abort();
        } catch (const wfpsf::Error &error) {
            if (error.status() != WFPSF_ERROR_FILE_FORMAT)
                std::abort();
        }
    }
    return 0;
}
