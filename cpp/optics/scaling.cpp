// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/scaling.hpp"

#include "numerics/dispatch.hpp"
#include "optics/sum_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;

// How much of eps the polynomial gets; the interpolation has the rest.
constexpr double share_of_terms = 0.3;

// out[i] = sum over the terms of weights[term] * rows[term][i].
WFPSF_VECTORISED void combine(const std::vector<double> &weights,
                              const std::vector<const double *> &rows, int64_t count, double *out) {
    int64_t begin = 0;
    for (; begin + block <= count; begin += block) {
        double registers[block];
        for (int64_t i = 0; i < block; ++i)
            registers[i] = 0;
        for (size_t term = 0; term < rows.size(); ++term) {
            const double *__restrict inputs = rows[term] + begin;
            for (int64_t i = 0; i < block; ++i)
                registers[i] += weights[term] * inputs[i];
        }
        for (int64_t i = 0; i < block; ++i)
            out[begin + i] = registers[i];
    }
    for (; begin < count; ++begin) {
        out[begin] = 0;
        for (size_t term = 0; term < rows.size(); ++term)
            out[begin] += weights[term] * rows[term][begin];
    }
}

// One wavelength's image: what it is made of, and where its samples along an axis lie among those
// it is interpolated from; `ratio` of their steps apart, and both have their middle on the axis.
struct SizedColour {
    std::vector<double> shares; // of the given images
    int64_t taps;
    std::vector<int64_t> first;  // tap of each sample
    std::vector<double> weights; // [sample * taps + tap]

    SizedColour(std::vector<double> of, const BandlimitedInterpolator &interpolator, int64_t from,
                int64_t to, double ratio)
        : shares(std::move(of)), taps(interpolator.taps()), first(static_cast<size_t>(to)),
          weights(static_cast<size_t>(to * taps)) {
        const auto half = [](int64_t size) { return static_cast<double>(size - 1) / 2; };
        for (int64_t i = 0; i <= to / 2; ++i) {
            double *const w = &weights[static_cast<size_t>(i * taps)];
            const int64_t at =
                interpolator.weights(half(from) + (static_cast<double>(i) - half(to)) * ratio, w);
            first[static_cast<size_t>(i)] = at;
            const int64_t mirrored = to - 1 - i;
            if (mirrored == i)
                break;
            first[static_cast<size_t>(mirrored)] = from - at - taps;
            std::reverse_copy(w, w + taps, &weights[static_cast<size_t>(mirrored * taps)]);
        }
    }
    int64_t begin(int64_t sample) const { return first[static_cast<size_t>(sample)]; }
    int64_t end(int64_t sample) const { return begin(sample) + taps; }
    const double *weights_of(int64_t sample) const {
        return &weights[static_cast<size_t>(sample * taps)];
    }
};

// Some rows of an image at a time, in tiles that stay in the cache.
class Rows {
  public:
    static constexpr int64_t most = 2 * block;

    Rows(std::span<const Plane<double>> images, int64_t taps)
        : images_(images), combined_(tile, most + taps + 1), lines_(tile, together),
          turned_(most, images[0].nx()) {}

    // Rows first..last-1 of an image as columns: (y - first, x).
    void make(const SizedColour &colour, int64_t first, int64_t last, Plane<double> &out) {
        const auto size = static_cast<int64_t>(colour.first.size());
        const int64_t left = colour.begin(0), right = colour.end(size - 1);
        for (int64_t x = left; x < right; x += tile)
            make_tile(colour, first, last, x, std::min(tile, right - x));
        for (int64_t x = 0; x < size; ++x) {
            const double *const start = turned_.view().row(colour.begin(x));
            sum_blocks(colour.weights_of(x), colour.taps, &start, 1, most, blocks_for(last - first),
                       out.view().row(x));
        }
    }

  private:
    static constexpr int64_t tile = 8 * block; // columns
    static constexpr int64_t together = 8;     // rows, that fill cache lines as they become columns

    // From the given images to columns of the rows, along y.
    void make_tile(const SizedColour &colour, int64_t first, int64_t last, int64_t left,
                   int64_t columns) {
        const int64_t low = colour.begin(first), rows = colour.end(last - 1) - low;
        std::vector<const double *> terms(images_.size());
        for (int64_t y = 0; y < rows; ++y) {
            for (size_t j = 0; j < terms.size(); ++j)
                terms[j] = images_[j].view().row(low + y) + left;
            combine(colour.shares, terms, columns, combined_.view().row(y));
        }
        for (int64_t y = first; y < last; y += together) {
            const int64_t count = std::min(together, last - y);
            for (int64_t i = 0; i < count; ++i) {
                const double *const start = combined_.view().row(colour.begin(y + i) - low);
                sum_blocks(colour.weights_of(y + i), colour.taps, &start, 1, tile,
                           blocks_for(columns), lines_.view().row(i));
            }
            for (int64_t x = 0; x < columns; ++x)
                for (int64_t i = 0; i < together; ++i)
                    turned_(y - first + i, left + x) = lines_(x, i);
        }
    }

    std::span<const Plane<double>> images_;
    Plane<double> combined_, lines_, turned_;
};

// Adds the first `count` rows of columns to a plane's rows from `first` on, and clears them all.
void add_turned(Plane<double> &columns, int64_t count, Plane<double> &sum, int64_t first) {
    constexpr int64_t together = 8; // rows
    for (int64_t y = 0; y < count; y += together)
        for (int64_t x = 0; x < sum.nx(); ++x)
            for (int64_t i = y; i < std::min(y + together, count); ++i)
                sum(x, first + i) += columns(i, x);
    std::fill_n(columns.view().data, columns.nx() * columns.ny(), 0.0);
}

} // namespace

// Through Chebyshev's points, the error of a wave exp(2 pi i W / lambda) is at most
// 2 (pi h W)^K / K! for K of them, where 1 / lambda ranges over 2h. An intensity is a sum over all
// pairs of points of such waves, W the pair's difference.
Scaling::Scaling(const ImageMaker &maker, double blue, double red, double eps)
    : blue_(blue), to_(maker.grid()), from_(to_.size) {
    const double middle = (1 / blue + 1 / red) / 2, half = (1 / blue - 1 / red) / 2;
    if (half == 0) {
        wavelengths_ = {blue};
        return;
    }
    const double turn = pi * half * maker.optics().wavelength;
    const WavefrontPairs pairs = maker.optics().aperture->pairs(maker.optics().wavefront);
    int terms = 0;
    double missed = 0;
    do
        missed = 2 * pairs.power(turn, ++terms);
    while (missed > std::max(share_of_terms * eps, AveragedSamples::rounding));
    for (int k = 0; k < terms; ++k)
        wavelengths_.push_back(1 / (middle + half * std::cos(pi * (k + 0.5) / terms)));
    samples_.emplace(maker.unaveraged((1 - share_of_terms) * eps));
    from_ += 2 * samples_->interpolator().half_width();
    error_ = missed + maker.strength() * samples_->missed() + AveragedSamples::rounding;
}

std::vector<double> Scaling::shares(double wavelength) const {
    std::vector<double> shares;
    for (const double own : wavelengths_) {
        double product = 1;
        for (const double other : wavelengths_)
            if (other != own)
                product *= (1 / wavelength - 1 / other) / (1 / own - 1 / other);
        shares.push_back(product);
    }
    return shares;
}

std::vector<Plane<double>> Scaling::sums(std::span<const Plane<double>> images,
                                         std::span<const double> colours,
                                         std::span<const std::vector<double>> weights,
                                         const Progress &progress) const {
    const int64_t size = to_.size;
    std::vector<Plane<double>> sums;
    if (!samples_) {
        for (const std::vector<double> &own : weights) {
            auto &sum = sums.emplace_back(Plane<double>::unset(size, size));
            for (int64_t y = 0; y < size; ++y)
                for (int64_t x = 0; x < size; ++x)
                    sum(x, y) = own[0] * images[0](x, y);
        }
        return sums;
    }
    const BandlimitedInterpolator &interpolator = samples_->interpolator();
    for (size_t s = 0; s < weights.size(); ++s)
        sums.emplace_back(size, size);
    Rows rows(images, interpolator.taps());
    Plane<double> image(Rows::most, size);
    std::vector<Plane<double>> columns(weights.size(), image); // of the sums of some colours
    // A few colours at a time: their weights stay in the cache, and so do the rows that they share.
    constexpr size_t together = 8;
    for (size_t begin = 0; begin < colours.size(); begin += together) {
        const size_t end = std::min(begin + together, colours.size());
        std::vector<SizedColour> some;
        for (size_t k = begin; k < end; ++k)
            some.emplace_back(shares(colours[k]), interpolator, from_, size, blue_ / colours[k]);
        for (int64_t first = 0; first < size; first += Rows::most) {
            const int64_t last = std::min(first + Rows::most, size);
            progress.report((static_cast<double>(begin) + static_cast<double>(end - begin) *
                                                              static_cast<double>(first) /
                                                              static_cast<double>(size)) /
                            static_cast<double>(colours.size()));
            for (size_t k = begin; k < end; ++k) {
                rows.make(some[k - begin], first, last, image);
                for (size_t s = 0; s < weights.size(); ++s)
                    add_scaled(weights[s][k], image.view().data, Rows::most * size,
                               columns[s].view().data);
            }
            for (size_t s = 0; s < weights.size(); ++s)
                add_turned(columns[s], last - first, sums[s], first);
        }
    }
    return sums;
}

} // namespace wfpsf
