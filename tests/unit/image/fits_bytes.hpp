// SPDX-License-Identifier: GPL-3.0-or-later
// FITS files made by hand, byte by byte, so that reader and writer are not each other's judge.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

inline std::string padded(std::string text, char filler) {
    text.resize((text.size() + 2879) / 2880 * 2880, filler);
    return text;
}

// Cards such as "BITPIX  =                   16"; END and padding are added.
inline std::string fits_header(const std::vector<std::string> &cards) {
    std::string text;
    for (std::string card : cards) {
        card.resize(80, ' ');
        text += card;
    }
    std::string end = "END";
    end.resize(80, ' ');
    return padded(text + end, ' ');
}

template <class T> std::string big_endian(const std::vector<T> &values) {
    std::string bytes;
    for (const T value : values) {
        char word[sizeof(T)];
        std::memcpy(word, &value, sizeof(T));
        if constexpr (std::endian::native == std::endian::little)
            std::reverse(word, word + sizeof(T));
        bytes.append(word, sizeof(T));
    }
    return bytes;
}

template <class T> std::string fits_data(const std::vector<T> &values) {
    return padded(big_endian(values), '\0');
}

inline std::vector<std::string>
image_cards(int bitpix, int64_t nx, int64_t ny,
            const std::string &first = "SIMPLE  =                    T") {
    return {first, "BITPIX  = " + std::to_string(bitpix), "NAXIS   = 2",
            "NAXIS1  = " + std::to_string(nx), "NAXIS2  = " + std::to_string(ny)};
}
