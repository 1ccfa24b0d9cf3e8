// SPDX-License-Identifier: GPL-3.0-or-later
// Light about a star as splines, in blocks of native pixels. What a block needs lies side by side
// in a few bytes a pixel, the brightest blocks first: drawing reads memory from front to back, and
// the cache holds what most stars are drawn from.
#pragma once

#include "image/view.hpp"
#include "optics/field.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace wfpsf {

struct LightSpline;

class LightBlocks {
  public:
    static constexpr int64_t wide = 16, high = 16; // native pixels
    static constexpr size_t most_parts = 8;

    // Light is a sum of parts, each with a weight of a star's own; those of a block have as many
    // samples a pixel.
    struct Part {
        size_t number;
        double brightest; // no pixel of the block gets more, wherever the star stands in its pixel
        const LightSpline *spline;
    };
    struct Block {
        int64_t x, y; // of its first pixel, from the star's
        double inner; // no pixel as near to the star is drawn, native pixels along both axes
        std::vector<Part> parts;
    };
    LightBlocks() = default;
    explicit LightBlocks(std::vector<Block> blocks);

    struct Bounds {
        double inner, radius; // native pixels along either axis that light is drawn between
        double floor;         // share of the light: what a part is no brighter than is left out
    };
    // Adds a star's light to rows first_row..last_row of an image of native pixels.
    template <class T>
    void add(const Star &star, std::span<const double> weights, const Bounds &bounds, View<T> image,
             int64_t first_row, int64_t last_row) const;

    int64_t memory() const { // bytes held
        return static_cast<int64_t>(coefficients_.size() * sizeof(int16_t) +
                                    parts_.size() * sizeof(StoredPart) +
                                    blocks_.size() * sizeof(StoredBlock));
    }

    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.blocks_, self.parts_, self.coefficients_);
    }

  private:
    struct StoredPart {
        size_t number;
        double brightest;
        float unit;   // of the coefficients
        size_t first; // of them
        template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
            archive(self.number, self.brightest, self.unit, self.first);
        }
    };
    struct StoredBlock {
        double brightest; // of the parts
        int64_t x, y, per_pixel;
        size_t first_part, parts;
    };
    std::vector<StoredBlock> blocks_; // the brightest first
    std::vector<StoredPart> parts_;
    std::vector<int16_t> coefficients_;
};

} // namespace wfpsf
