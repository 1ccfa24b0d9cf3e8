// SPDX-License-Identifier: GPL-3.0-or-later
// The light about a star in the middle of an image, out to some radius: splines, and how many
// samples a pixel it takes where.
#pragma once

#include "scene/light_blocks.hpp"
#include "scene/sampled_light.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace wfpsf {

struct MiddleLight {
    // As far as an exact PSF reaches, if there is one, it stands for far light.
    MiddleLight(const FarLight &light, const Psf *exact, double radius, double floor, int threads);

    struct Cell { // a part of a block, along both axes
        static constexpr int64_t size = 8;
        int64_t x, y; // as blocks'
        double light; // of a pixel on the average
    };
    struct Block {
        int64_t x, y; // of the first pixel, from the star's
        double brightest = 0;
        double tolerance = 0;  // what splines may be off
        double off = 0;        // what those of one sample a pixel are
        int64_t per_pixel = 1; // what it takes
        std::vector<Cell> cells = {};

        // The samples that its pixels may fall on, and those of blocks beside it.
        SampleRange samples(int64_t per_pixel, int64_t blocks = 1) const;
        bool reaches_within(double radius) const;
        // The nearest that the borders of samples may be.
        int64_t half_width() const;
    };

    double inner; // no pixel as near to the star is drawn
    double radius, floor;
    std::vector<Block> blocks;        // those of a row in turn
    std::vector<LightSpline> splines; // of 1, 2, 4 samples a pixel
    const LightSpline &spline(int64_t per_pixel) const {
        return splines[static_cast<size_t>(per_pixel / 2)];
    }

    // Of blocks that are wanted: how far their samples reach, and work(range) on those.
    template <class Wanted> int64_t half_width(const Wanted &wanted) const {
        int64_t most = 16; // splines have so many samples or more
        for (const Block &of : blocks)
            if (wanted(of))
                most = std::max(most, of.half_width());
        return most;
    }
    template <class Wanted, class Work>
    void on_runs(int64_t per_pixel, const Wanted &wanted, const Work &work) const {
        for (size_t i = 0; i < blocks.size();) {
            const Block &first = blocks[i];
            int64_t count = 0;
            while (i < blocks.size() && wanted(blocks[i]) && blocks[i].y == first.y &&
                   blocks[i].x == first.x + count * LightBlocks::wide) {
                ++count;
                ++i;
            }
            if (count > 0)
                work(first.samples(per_pixel, count));
            else
                ++i;
        }
    }

  private:
    void find_tolerances(const SampledLight &light);
};

// No pixel within that radius of the star is in a block beyond the borders.
int64_t half_width(double radius);

} // namespace wfpsf
