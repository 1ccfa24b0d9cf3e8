// SPDX-License-Identifier: GPL-3.0-or-later
// A number that tells whether two pieces of work are the same: FNV-1a of all that goes into them.
#pragma once

#include <bit>
#include <cstdint>
#include <string_view>

namespace wfpsf {

class Fingerprint {
  public:
    void add(uint64_t bits) {
        for (int byte = 0; byte < 8; ++byte)
            hash_ = (hash_ ^ (bits >> (8 * byte) & 0xff)) * 0x100000001b3;
    }
    void add(int64_t value) { add(static_cast<uint64_t>(value)); }
    void add(int32_t value) { add(static_cast<int64_t>(value)); }
    void add(double value) { add(std::bit_cast<uint64_t>(value)); }
    void add(std::string_view text) {
        for (const char c : text)
            add(static_cast<int64_t>(c));
        add(static_cast<uint64_t>(text.size()));
    }

    uint64_t value() const { return hash_; }

  private:
    uint64_t hash_ = 0xcbf29ce484222325;
};

} // namespace wfpsf
