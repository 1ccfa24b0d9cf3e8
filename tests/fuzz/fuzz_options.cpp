// SPDX-License-Identifier: GPL-3.0-or-later
// The options setters of the C interface on any keys, values and null pointers: each call returns a
// status of the list, and a value that was refused is not kept.
#include "fuzz.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

#include <wfpsf/options.h>

namespace {

#define WFPSF_FUZZ_KEY(name, key, kind, standard, smallest, largest, text) key,
const int32_t keys[] = {WFPSF_OPTION_LIST(WFPSF_FUZZ_KEY)};
#undef WFPSF_FUZZ_KEY

// Takes numbers off the input; zeros when it is used up.
class Reader {
  public:
    Reader(const uint8_t *data, size_t size) : data_(data), left_(size) {}
    bool empty() const { return left_ == 0; }
    template <class T> T next() {
        T value{};
        const size_t n = std::min(left_, sizeof(T));
        std::memcpy(&value, data_, n);
        data_ += n;
        left_ -= n;
        return value;
    }

  private:
    const uint8_t *data_;
    size_t left_;
};

void require(bool fact) {
    if (!fact)
        std::abort();
}

bool is_listed(wfpsf_status status) {
    return std::strcmp(wfpsf_status_name(status), "unknown status") != 0;
}

bool is_same(double a, double b) {
    return a == b || (std::isnan(a) && std::isnan(b));
}

double next_real(Reader &reader) {
    using Limits = std::numeric_limits<double>;
    const double special[] = {0,    -1,    1e-6, Limits::quiet_NaN(),  Limits::infinity(),
                              0.05, 1e300, 16,   Limits::denorm_min(), -Limits::infinity()};
    const auto choice = reader.next<uint8_t>();
    return choice < 128 ? special[choice % std::size(special)] : reader.next<double>();
}

void call_once(Reader &reader, wfpsf_options *options) {
    const auto choice = reader.next<uint8_t>();
    const auto which = reader.next<uint8_t>();
    const int32_t key = which < 224 ? keys[which % std::size(keys)] : reader.next<int32_t>();
    wfpsf_options *handle = choice & 128 ? nullptr : options;
    double before = 0, after = 0;
    const wfpsf_status known = wfpsf_options_get(options, key, &before);
    wfpsf_status status = WFPSF_OK;
    double wanted = 0;
    switch (choice % 5) {
    case 0:
        wanted = next_real(reader);
        status = wfpsf_options_set_real(handle, key, wanted);
        break;
    case 1: {
        const auto integer = reader.next<int64_t>() >> (reader.next<uint8_t>() % 64);
        wanted = static_cast<double>(integer);
        status = wfpsf_options_set_integer(handle, key, integer);
        break;
    }
    case 2: {
        std::vector<double> coefficients(reader.next<uint8_t>() + 1u);
        for (double &coefficient : coefficients)
            coefficient = next_real(reader);
        // A count may lie, but only where it is refused before the array is read.
        const int64_t count = choice & 64 ? -1 - which : static_cast<int64_t>(coefficients.size());
        status =
            wfpsf_options_set_zernikes(handle, count, which == 7 ? nullptr : coefficients.data());
        break;
    }
    case 3:
        status = wfpsf_options_reset(handle, key);
        break;
    default:
        status = wfpsf_options_get(handle, key, which % 3 ? &after : nullptr);
    }
    require(is_listed(status));
    require(handle || status == WFPSF_ERROR_NULL);
    require(wfpsf_options_get(options, key, &after) == known);
    if (known == WFPSF_OK && status != WFPSF_OK)
        require(is_same(before, after));
    if (status == WFPSF_OK && choice % 5 <= 1)
        require(is_same(wanted, after));
    char line[64];
    require(wfpsf_last_error(line, choice % 65) >= 0);
}

} // namespace

std::vector<std::string> fuzz_seeds() {
    return {std::string(64, '\0'), std::string(4000, '\1')};
}

void fuzz_mutate(std::string &input, const std::vector<std::string> &, std::mt19937_64 &random) {
    input.resize(random() % 4096);
    for (char &byte : input)
        byte = static_cast<char>(random());
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    wfpsf_options *options = nullptr;
    require(wfpsf_options_create(nullptr) == WFPSF_ERROR_NULL);
    if (wfpsf_options_create(&options) != WFPSF_OK)
        return 0;
    for (Reader reader(data, size); !reader.empty();)
        call_once(reader, options);
    wfpsf_options_destroy(options);
    wfpsf_options_destroy(nullptr);
    return 0;
}
