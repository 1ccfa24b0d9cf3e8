// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/scaling_tiles.hpp"

#include "numerics/dispatch.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <tuple>
#include <utility>

namespace wfpsf {

namespace {

constexpr int64_t tile = 64;     // samples along an axis
constexpr int64_t together = 16; // rows, that fill cache lines as they become columns

// As many numbers as most processors' vector instructions take, by name: loops over so few of them
// the compiler would rather unroll.
template <class T> struct Vector {
    static constexpr int64_t lanes = static_cast<int64_t>(32 / sizeof(T));
    typedef T type [[gnu::vector_size(32)]];
};

// sums[i] = sum over the terms of weights[term] * input(term)[i], for n vectors of them.
template <int64_t n, class T, class Input>
[[gnu::always_inline]] inline void sum_vectors(const T *weights, int64_t terms, const Input &input,
                                               T *sums) {
    using Numbers = typename Vector<T>::type;
    Numbers registers[n] = {};
    for (int64_t term = 0; term < terms; ++term)
        for (int64_t i = 0; i < n; ++i) {
            Numbers some;
            std::memcpy(&some, input(term) + i * Vector<T>::lanes, sizeof(some));
            registers[i] += weights[term] * some;
        }
    std::memcpy(sums, registers, sizeof(registers));
}

// The same for `count` sums, or up to a line of the cache more.
constexpr int64_t long_run = 8, short_run = 2; // vectors at a time
template <class T> constexpr int64_t line = short_run *Vector<T>::lanes;
template <class T, class Input>
[[gnu::always_inline]] inline void sum_row(const T *weights, int64_t terms, const Input &input,
                                           int64_t count, T *sums) {
    constexpr int64_t many = long_run * Vector<T>::lanes;
    int64_t begin = 0;
    const auto from_begin = [&](int64_t term) __attribute__((always_inline)) {
        return input(term) + begin;
    };
    for (; begin + many <= count; begin += many)
        sum_vectors<long_run>(weights, terms, from_begin, sums + begin);
    for (; begin < count; begin += line<T>)
        sum_vectors<short_run>(weights, terms, from_begin, sums + begin);
}

// Of inputs that stand `stride` apart.
template <class T>
WFPSF_VECTORISED void filter_row(const T *weights, int64_t taps, const T *start, int64_t stride,
                                 int64_t count, T *sums) {
    const auto input = [=](int64_t tap) __attribute__((always_inline)) {
        return start + tap * stride;
    };
    sum_row(weights, taps, input, count, sums);
}

template <class T>
WFPSF_VECTORISED void combine_row(const T *weights, int64_t terms, const T *const *rows,
                                  int64_t count, T *sums) {
    const auto input = [=](int64_t term) __attribute__((always_inline)) {
        return rows[term];
    };
    sum_row(weights, terms, input, count, sums);
}

// Sums of a tile's columns, added to each of some others so many times.
template <class T>
WFPSF_VECTORISED void add_filtered(const T *weights, int64_t taps, const T *start,
                                   const std::vector<double> &times, T *const *sums) {
    T column[tile];
    const auto input = [=](int64_t tap) __attribute__((always_inline)) {
        return start + tap * tile;
    };
    sum_row(weights, taps, input, tile, column);
    for (size_t s = 0; s < times.size(); ++s) {
        T *__restrict sum = sums[s];
        const auto factor = static_cast<T>(times[s]);
        for (int64_t i = 0; i < tile; ++i)
            sum[i] += factor * column[i];
    }
}

// Rows of `length` as columns of a tile.
template <class T>
WFPSF_VECTORISED void turn(const T *rows, int64_t length, int64_t count, T *columns) {
    for (int64_t x = 0; x < count; ++x)
        for (int64_t i = 0; i < together; ++i)
            columns[x * tile + i] = rows[i * length + x];
}

template <class T> WFPSF_VECTORISED void convert(const double *from, int64_t count, T *to) {
    for (int64_t i = 0; i < count; ++i)
        to[i] = static_cast<T>(from[i]);
}

} // namespace

// One colour: where the samples of its image along an axis lie among those of the terms. Both have
// their middle on the axis.
class ScaledTiles::Sized {
  public:
    // Within `half` samples of the axis.
    Sized(const ScaledColour &colour, size_t terms, int64_t from, int64_t to, double half,
          std::span<const Filter> filters)
        : colour_(&colour), from_(from), to_(to),
          first_(
              std::max<int64_t>(static_cast<int64_t>(static_cast<double>(to - 1) / 2 - half), 0)),
          filters_(filters) {
        of<double>().along.resize(filters.size());
        of<float>().along.resize(filters.size());
        double below = colour.x, here = 1;
        for (size_t m = 0; m < terms; ++m) {
            of<double>().chebyshev.push_back(here);
            of<float>().chebyshev.push_back(static_cast<float>(here));
            below = std::exchange(here, 2 * colour.x * here - below);
        }
    }

    const std::vector<double> &weights() const { return colour_->weights; }
    template <class T> const T *chebyshev() const { return of<T>().chebyshev.data(); }

    // What samples first..last-1 lie among.
    Range among(int64_t first, int64_t last) const {
        return {std::max<int64_t>(static_cast<int64_t>(position(first)), 0),
                std::min(static_cast<int64_t>(position(last - 1)) + 2, from_)};
    }

    template <class T> struct Along {
        int64_t taps = 0;
        std::vector<int64_t> first; // tap of each sample
        std::vector<T> weights;     // [sample * taps + tap]
        int64_t begin(int64_t sample) const { return first[static_cast<size_t>(sample)]; }
        int64_t end(int64_t sample) const { return begin(sample) + taps; }
        const T *weights_of(int64_t sample) const {
            return &weights[static_cast<size_t>(sample * taps)];
        }
    };
    template <class T> const Along<T> &along(size_t filter) {
        Along<T> &along = of<T>().along[filter];
        if (along.taps == 0)
            make(filters_[filter].interpolator, along);
        return along;
    }

  private:
    template <class T> struct InPrecision;
    template <class T> InPrecision<T> &of() { return std::get<InPrecision<T>>(precisions_); }
    template <class T> const InPrecision<T> &of() const {
        return std::get<InPrecision<T>>(precisions_);
    }
    double position(int64_t sample) const {
        return static_cast<double>(from_ - 1) / 2 +
               (static_cast<double>(sample) - static_cast<double>(to_ - 1) / 2) * colour_->ratio;
    }
    template <class T>
    void make(const BandlimitedInterpolator &interpolator, Along<T> &along) const {
        const int64_t taps = along.taps = interpolator.taps();
        along.first.resize(static_cast<size_t>(to_));
        along.weights.resize(static_cast<size_t>(to_ * taps));
        std::vector<double> w(static_cast<size_t>(taps));
        const auto put = [&](int64_t sample, int64_t first, auto begin, auto end) {
            along.first[static_cast<size_t>(sample)] = first;
            std::transform(begin, end, &along.weights[static_cast<size_t>(sample * taps)],
                           [](double weight) { return static_cast<T>(weight); });
        };
        for (int64_t i = first_; i <= to_ / 2; ++i) {
            const int64_t at = interpolator.weights(position(i), w.data());
            put(i, at, w.begin(), w.end());
            put(to_ - 1 - i, from_ - at - taps, w.rbegin(), w.rend());
        }
    }

    const ScaledColour *colour_;
    int64_t from_, to_, first_;
    std::span<const Filter> filters_;
    template <class T> struct InPrecision {
        std::vector<T> chebyshev;
        std::vector<Along<T>> along; // by filter, once it is asked for
    };
    std::tuple<InPrecision<double>, InPrecision<float>> precisions_;
};

ScaledTiles::Choice ScaledTiles::choose(Range x, Range y) const {
    const auto [terms, light] = terms_.light(x, y, economy_.negligible);
    size_t filter = 0;
    while (filter + 1 < economy_.filters.size() && light <= economy_.filters[filter + 1].up_to)
        ++filter;
    return {terms, filter, light <= economy_.single_precision};
}

ScaledTiles::ScaledTiles(const ScalingTerms &terms, int64_t size, double half,
                         const Economy &economy)
    : terms_(terms), size_(size), economy_(economy) {
    const auto outside =
        static_cast<int64_t>(std::ceil(std::max(static_cast<double>(size - 1) / 2 - half, 0.0)));
    within_ = {outside, size - outside};
}

template <class T>
void ScaledTiles::add_tile(std::span<Sized> colours, const Tile &t, Choice choice, Work<T> &work,
                           std::span<Plane<double>> sums) const {
    Range x{terms_.size(), 0}, y = x;
    for (Sized &colour : colours) {
        const auto &along = colour.along<T>(choice.filter);
        x = {std::min(x.begin, along.begin(t.x0)), std::max(x.end, along.end(t.x1 - 1))};
        y = {std::min(y.begin, along.begin(t.y0)), std::max(y.end, along.end(t.y1 - 1))};
    }
    const int64_t width = x.end - x.begin + line<T>; // a sum may read beyond
    const auto make = [](Plane<T> &plane, int64_t nx, int64_t ny) {
        if (plane.nx() < nx || plane.ny() < ny)
            plane = Plane<T>(std::max(plane.nx(), nx), std::max(plane.ny(), ny));
    };
    work.terms.resize(std::max(work.terms.size(), choice.terms));
    for (size_t m = 0; m < choice.terms; ++m) {
        make(work.terms[m], width, y.end - y.begin);
        for (int64_t row = y.begin; row < y.end; ++row)
            convert(terms_[m].view().row(row) + x.begin, x.end - x.begin,
                    work.terms[m].view().row(row - y.begin));
    }
    make(work.combined, width, y.end - y.begin);
    make(work.lines, width, together);
    make(work.turned, tile, width);
    work.columns.resize(sums.size());
    for (Plane<T> &columns : work.columns)
        make(columns, tile, tile);
    const auto terms = static_cast<int64_t>(choice.terms);
    std::vector<const T *> starts(choice.terms);
    std::vector<T *> into(sums.size());
    for (Sized &colour : colours) {
        const auto &along = colour.along<T>(choice.filter);
        const int64_t left = along.begin(t.x0), columns = along.end(t.x1 - 1) - left;
        const int64_t low = along.begin(t.y0), rows = along.end(t.y1 - 1) - low;
        for (int64_t row = 0; row < rows; ++row) {
            for (size_t m = 0; m < choice.terms; ++m)
                starts[m] = work.terms[m].view().row(low - y.begin + row) + left - x.begin;
            combine_row(colour.chebyshev<T>(), terms, starts.data(), columns,
                        work.combined.view().row(row));
        }
        for (int64_t first = t.y0; first < t.y1; first += together) {
            const int64_t count = std::min(together, t.y1 - first);
            for (int64_t i = 0; i < count; ++i)
                filter_row(along.weights_of(first + i), along.taps,
                           work.combined.view().row(along.begin(first + i) - low),
                           work.combined.nx(), columns, work.lines.view().row(i));
            turn(work.lines.view().data, work.lines.nx(), columns,
                 work.turned.view().data + (first - t.y0));
        }
        for (int64_t column = t.x0; column < t.x1; ++column) {
            for (size_t s = 0; s < sums.size(); ++s)
                into[s] = work.columns[s].view().row(column - t.x0);
            add_filtered(along.weights_of(column), along.taps,
                         work.turned.view().row(along.begin(column) - left), colour.weights(),
                         into.data());
        }
    }
    for (size_t s = 0; s < sums.size(); ++s) {
        for (int64_t row = t.y0; row < t.y1; ++row)
            for (int64_t column = t.x0; column < t.x1; ++column)
                sums[s](column, row) +=
                    static_cast<double>(work.columns[s](row - t.y0, column - t.x0));
        std::fill_n(work.columns[s].view().data, tile * tile, T(0));
    }
}

void ScaledTiles::add(std::span<const ScaledColour> colours, double half, double beyond,
                      std::span<Plane<double>> sums) {
    std::vector<Sized> sized;
    for (const ScaledColour &colour : colours)
        sized.emplace_back(colour, terms_.count(), terms_.size(), size_, half, economy_.filters);
    const double middle = static_cast<double>(size_ - 1) / 2;
    const auto farthest = [middle](int64_t first, int64_t last) {
        return std::max(std::abs(static_cast<double>(first) - middle),
                        std::abs(static_cast<double>(last - 1) - middle));
    };
    const auto among = [&sized](int64_t first, int64_t last) {
        Range range = sized[0].among(first, last);
        for (const Sized &colour : sized) {
            const Range own = colour.among(first, last);
            range = {std::min(range.begin, own.begin), std::max(range.end, own.end)};
        }
        return range;
    };
    for (int64_t y = within_.begin; y < within_.end; y += tile)
        for (int64_t x = within_.begin; x < within_.end; x += tile) {
            const Tile t{x, std::min(x + tile, within_.end), y, std::min(y + tile, within_.end)};
            const double off = std::max(farthest(t.x0, t.x1), farthest(t.y0, t.y1));
            if (off > half || off <= beyond)
                continue;
            const Choice choice = choose(among(t.x0, t.x1), among(t.y0, t.y1));
            if (choice.single_precision)
                add_tile(sized, t, choice, single_, sums);
            else
                add_tile(sized, t, choice, double_, sums);
        }
}

} // namespace wfpsf
