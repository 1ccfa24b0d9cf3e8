// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/ipc_sweep.hpp"

#include "numerics/dispatch.hpp"
#include "numerics/fft.hpp"
#include "numerics/working_plane.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace wfpsf {

namespace {

// An axis' own couplings, with the other axis at a frequency of that cosine.
struct Row {
    double centre, neighbour;
};
Row row_at(const IpcKernel &kernel, bool along_x, double cosine) {
    const auto tap = [&](int64_t along, int64_t across) {
        return along_x ? kernel.tap_or_zero(along, across) : kernel.tap_or_zero(across, along);
    };
    return {tap(0, 0) + 2 * tap(0, 1) * cosine, tap(1, 0) + 2 * tap(1, 1) * cosine};
}

// How far the inverse reaches, in pixels: it falls as exp(-acosh(centre / 2 neighbour)) a pixel,
// slowest where the other axis' cosine is extreme.
double reach_of(const IpcKernel &kernel) {
    double slowest = HUGE_VAL, least = 1;
    for (const bool along_x : {true, false})
        for (const double cosine : {-1, 1}) {
            const Row row = row_at(kernel, along_x, cosine);
            const double share = 2 * std::fabs(row.neighbour);
            least = std::min(least, row.centre - share);
            slowest = std::min(slowest, least > 0 ? std::acosh(row.centre / share) : 0);
        }
    constexpr double digits = 40; // exp(-40) is 4e-18
    return std::ceil((digits - std::log(least)) / slowest);
}

// The place in an axis that stands at index i beyond it, and its sign; sign 0: nothing.
struct Place {
    int64_t index;
    double sign;
};
Place place_of(int64_t i, int64_t n, Continuation continuation) {
    if (i >= 0 && i < n)
        return {i, 1};
    switch (continuation) {
    case Continuation::periodic:
        return {(i % n + n) % n, 1};
    case Continuation::even:
        return {i < 0 ? -1 - i : 2 * n - 1 - i, 1};
    case Continuation::odd:
        break;
    }
    return i == -1 || i == n ? Place{0, 0} : Place{i < 0 ? -2 - i : 2 * n - i, -1};
}

// row = (row - b before) m
WFPSF_VECTORISED void eliminate(const double *b, const double *m, const double *before, size_t n,
                                double *__restrict row) {
    for (size_t i = 0; i < n; ++i)
        row[i] = (row[i] - b[i] * before[i]) * m[i];
}

// row -= b m after
WFPSF_VECTORISED void substitute(const double *b, const double *m, const double *after, size_t n,
                                 double *__restrict row) {
    for (size_t i = 0; i < n; ++i)
        row[i] -= b[i] * m[i] * after[i];
}

// The reciprocals of the pivots of each row: those of an endless matrix soon come to rest.
class Pivots {
  public:
    Pivots(const std::vector<double> &a, const std::vector<double> &b, int64_t rows, bool is_even)
        : last_(rows - 1) {
        const size_t n = a.size();
        bool rests = false;
        for (int64_t y = 0; y < rows && !(rests && y < rows - 1); ++y) {
            std::vector<double> pivot(n);
            rests = y > 1;
            for (size_t i = 0; i < n; ++i) {
                const double ends = is_even ? (y == 0 ? b[i] : 0) + (y == rows - 1 ? b[i] : 0) : 0;
                const double before = y == 0 ? 0 : b[i] * b[i] * pivots_.back()[i];
                pivot[i] = 1 / (a[i] + ends - before);
                rests = rests && std::fabs(pivot[i] - pivots_.back()[i]) <= 2e-16 * pivot[i];
            }
            pivots_.push_back(std::move(pivot));
        }
        if (static_cast<int64_t>(pivots_.size()) < rows) {
            end_ = pivots_.back();
            if (is_even)
                for (size_t i = 0; i < n; ++i)
                    end_[i] = 1 / (a[i] + b[i] - b[i] * b[i] * pivots_.back()[i]);
        } else {
            end_ = pivots_.back();
        }
    }
    const double *operator()(int64_t y) const {
        return y == last_ ? end_.data()
                          : pivots_[std::min(static_cast<size_t>(y), pivots_.size() - 1)].data();
    }

  private:
    int64_t last_;
    std::vector<std::vector<double>> pivots_;
    std::vector<double> end_;
};

// A row's two halves, each continued on both sides, as the real and the imaginary part of one
// sequence: a filter whose transform is real and even leaves them apart.
class HalfRows {
  public:
    HalfRows(int64_t n, int64_t reach, Continuation continuation)
        : n_(n), half_((n + 1) / 2), reach_(reach), length_(good_fft_length(half_ + 2 * reach)),
          continuation_(continuation), fft_(length_) {}
    int64_t length() const { return length_; }

    void transform(const double *row, double scale, std::complex<double> *modes) const {
        const auto at = [&](int64_t x) {
            const Place place = place_of(x, n_, continuation_);
            return place.sign == 0 ? 0 : place.sign * scale * row[place.index];
        };
        const int64_t end = half_ + 2 * reach_, right = half_ - reach_;
        for (int64_t i = 0; i < end; ++i) {
            const bool inside = i >= reach_ && right + i < n_ && i - reach_ < n_;
            modes[i] = inside ? std::complex(scale * row[i - reach_], scale * row[right + i])
                              : std::complex(at(i - reach_), at(right + i));
        }
        std::fill(modes + end, modes + length_, 0);
        fft_.run(modes);
    }

    // Transforming forward twice turns a sequence round.
    void back(std::complex<double> *modes, double *row) const {
        fft_.run(modes);
        for (int64_t x = 0; x < half_; ++x)
            row[x] = modes[length_ - reach_ - x].real();
        for (int64_t x = half_; x < n_; ++x)
            row[x] = modes[length_ - reach_ - (x - half_)].imag();
    }

  private:
    int64_t n_, half_, reach_, length_;
    Continuation continuation_;
    BackwardFft fft_;
};

} // namespace

bool divide_by_sweeps(const IpcKernel &kernel, Continuation continuation, View<double> image) {
    const double reach_exact = reach_of(kernel);
    const auto shortest = static_cast<double>(std::min(image.nx / 2, image.ny));
    if (!(reach_exact >= 1 && reach_exact < shortest))
        return false;
    const auto reach = static_cast<int64_t>(reach_exact);
    const HalfRows rows(image.nx, reach, continuation);
    const int64_t beyond = continuation == Continuation::periodic ? reach : 0;
    const int64_t count = image.ny + 2 * beyond;

    const int64_t n = rows.length();
    std::vector<double> a, b; // of real and imaginary parts
    for (int64_t k = 0; k < n; ++k) {
        const double cosine =
            std::cos(2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n));
        const Row row = row_at(kernel, false, cosine);
        a.insert(a.end(), 2, row.centre);
        b.insert(b.end(), 2, row.neighbour);
    }
    const Pivots pivots(a, b, count, continuation == Continuation::even);

    WorkingPlane<std::complex<double>> memory(n, count);
    const View<std::complex<double>> modes = memory.view();
    const auto numbers = [&](int64_t y) { return reinterpret_cast<double *>(modes.row(y)); };
    const std::vector<double> nothing(a.size());
    for (int64_t y = 0; y < count; ++y) {
        const Place place = place_of(y - beyond, image.ny, continuation);
        rows.transform(image.row(place.index), 1 / static_cast<double>(n), modes.row(y));
        eliminate(b.data(), pivots(y), y > 0 ? numbers(y - 1) : nothing.data(), a.size(),
                  numbers(y));
    }
    // A row is transformed back once the one below it no longer needs its modes.
    for (int64_t y = count - 1; y >= 0; --y) {
        if (y + 1 < count)
            substitute(b.data(), pivots(y), numbers(y + 1), a.size(), numbers(y));
        if (y + 1 < count && y + 1 >= beyond && y + 1 < beyond + image.ny)
            rows.back(modes.row(y + 1), image.row(y + 1 - beyond));
    }
    if (beyond == 0)
        rows.back(modes.row(0), image.row(0));
    return true;
}

} // namespace wfpsf
