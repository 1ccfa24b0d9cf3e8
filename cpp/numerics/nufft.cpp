// SPDX-License-Identifier: GPL-3.0-or-later
#include "numerics/nufft.hpp"

#include "numerics/dispatch.hpp"
#include "numerics/fft.hpp"
#include "numerics/phasor.hpp"
#include "numerics/quadrature.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;
using Complex = std::complex<double>;

constexpr int narrowest = 4, widest = 16; // kernel widths, fine grid cells
constexpr int64_t batch = 16;             // columns or rows transformed together

// Cells of the fine grid to a mode. Fewer make shorter transforms and wider kernels; but rounding is
// multiplied by up to 10^5 where such a kernel's transform is smallest.
constexpr double fine = 2, coarse = 1.5;
double oversampling_for(double eps) {
    constexpr double least_of_coarse = 1e-9;
    return eps < least_of_coarse ? fine : coarse;
}

// The spreading kernel exp(beta (sqrt(1 - z^2) - 1)), |z| < 1, over `width` cells.
double kernel(double beta, double z) {
    return std::abs(z) < 1 ? std::exp(beta * (std::sqrt(1 - z * z) - 1)) : 0;
}

// From the rate of Barnett et al., and measured: a single source errs by 4 eps at worst, many of
// them by far less.
int width_for(double eps) {
    const double digits = -std::log10(std::max(eps, nufft_best_eps));
    const double digits_per_cell =
        pi * std::numbers::log10e * std::sqrt(1 - 1 / oversampling_for(eps));
    return std::clamp(static_cast<int>(std::ceil(digits / digits_per_cell + 1.5)), narrowest,
                      widest);
}

double beta_for(int width, double oversampling) {
    return 0.97 * pi * (1 - 1 / (2 * oversampling)) * width;
}

int64_t fine_cells(int64_t K, int width, double oversampling) {
    const double modes = static_cast<double>(2 * K + 1);
    return good_fft_length(
        std::max(static_cast<int64_t>(std::ceil(oversampling * modes)), int64_t{2} * width));
}

WFPSF_VECTORISED void add_wave(double weight, double turns, std::vector<double> &sums) {
    for (size_t k = 0; k < sums.size(); ++k) {
        double cosine, sine;
        phasor(turns * static_cast<double>(k), cosine, sine);
        sums[k] += weight * cosine;
    }
}

// One over the transform of the kernel at modes -K..K of a fine grid of n cells.
std::vector<double> kernel_correction(int width, double beta, int64_t K, int64_t n) {
    const GaussLegendre rule(2 * width + 12);
    const double half = width / 2.0;
    std::vector<double> modes(static_cast<size_t>(K + 1));
    for (size_t i = 0; i < rule.x.size(); ++i)
        add_wave(rule.w[i] * half * kernel(beta, rule.x[i]),
                 half * rule.x[i] / static_cast<double>(n), modes);
    std::vector<double> correction(static_cast<size_t>(2 * K + 1));
    for (size_t k = 0; k < modes.size(); ++k)
        correction[modes.size() - 1 - k] = correction[modes.size() - 1 + k] = 1 / modes[k];
    return correction;
}

// The kernel at all W cells around a source, as one polynomial a cell in the source's offset
// within its cell: coefficients fitted through Chebyshev's points.
template <int W> class KernelPolynomials {
  public:
    explicit KernelPolynomials(double beta) {
        constexpr int n = degree + 1;
        for (int cell = 0; cell < W; ++cell) {
            std::array<double, n> chebyshev{};
            for (int i = 0; i < n; ++i) {
                const double angle = pi * (i + 0.5) / n;
                const double value = kernel(beta, position(cell, std::cos(angle)));
                for (int k = 0; k < n; ++k)
                    chebyshev[static_cast<size_t>(k)] +=
                        (k == 0 ? 1.0 : 2.0) / n * value * std::cos(k * angle);
            }
            to_monomials(chebyshev, cell);
        }
    }

    // Whole vectors: the kernel is zero in the cells beyond W.
    static constexpr size_t padded = (W + 3) / 4 * 4;

    // Values at cells 0..W-1 for a source at offset z in [-1, 1] of half a cell.
    [[gnu::always_inline]] void evaluate(double z, double *values) const {
        for (size_t cell = 0; cell < padded; ++cell)
            values[cell] = coefficients_[degree][cell];
        for (size_t k = degree; k-- > 0;)
            for (size_t cell = 0; cell < padded; ++cell)
                values[cell] = values[cell] * z + coefficients_[k][cell];
    }

  private:
    static constexpr size_t degree = W + 3;

    // The kernel's argument: cell centre minus source, in half widths.
    static double position(int cell, double z) { return (2 * cell + 1 - W - z) / W; }

    void to_monomials(const std::array<double, degree + 1> &chebyshev, int cell) {
        std::array<double, degree + 1> t_below{}, t{}, t_above{};
        t_below[0] = 1;
        t[1] = 1;
        for (size_t m = 0; m <= degree; ++m)
            coefficients_[m][static_cast<size_t>(cell)] =
                chebyshev[0] * t_below[m] + chebyshev[1] * t[m];
        for (size_t k = 2; k <= degree; ++k) {
            for (size_t m = 0; m <= degree; ++m)
                t_above[m] = (m > 0 ? 2 * t[m - 1] : 0) - t_below[m];
            for (size_t m = 0; m <= degree; ++m)
                coefficients_[m][static_cast<size_t>(cell)] += chebyshev[k] * t_above[m];
            t_below = std::exchange(t, t_above);
        }
    }

    std::array<std::array<double, padded>, degree + 1> coefficients_{};
};

// Where a source stands on an axis of the fine grid: the first of the W cells that it is spread
// over, and its offset from their middle in half cells.
template <int W> struct Place {
    int64_t cell;
    double offset;
    [[gnu::always_inline]] Place(double angle, double cells_per_radian) {
        const double scaled = angle * cells_per_radian;
        const double below = std::floor(scaled - W / 2.0);
        cell = static_cast<int64_t>(below) + 1;
        offset = 2 * (scaled - below - (W + 1) / 2.0);
    }
};

// Four numbers, by name: what the compiler makes of loops over so few is slower.
using Four [[gnu::vector_size(32)]] = double;
[[gnu::always_inline]] inline void add_to(double *sums, const Four &numbers) {
    Four sum;
    std::memcpy(&sum, sums, sizeof(sum));
    sum += numbers;
    std::memcpy(sums, &sum, sizeof(sum));
}

// The weights around a source along one axis.
template <int W> struct AlongAxis {
    static constexpr size_t padded = KernelPolynomials<W>::padded;
    alignas(32) double weights[padded];

    [[gnu::always_inline]] AlongAxis(const KernelPolynomials<W> &polynomials, double offset) {
        polynomials.evaluate(offset, weights);
    }
    // Adds a number times the weights.
    [[gnu::always_inline]] void add(double number, double *sums) const {
        for (size_t k = 0; k < padded; k += 4) {
            Four four;
            std::memcpy(&four, weights + k, sizeof(four));
            add_to(sums + k, number * four);
        }
    }
    // The same of a complex number.
    [[gnu::always_inline]] void add(double re, double im, double *sums) const {
        const Four number{re, im, re, im};
        for (size_t k = 0; k < padded; k += 2)
            add_to(sums + 2 * k,
                   number * Four{weights[k], weights[k], weights[k + 1], weights[k + 1]});
    }
};

// Adds sources to the cells around them, in each of several planes of cells: (first_x, first_y) is
// the cell that stands at the beginning of a plane, and a plane's sources follow another's. Sources
// one above the other are added to a column first, all along y, and that to the cells.
template <int W>
WFPSF_VECTORISED void spread_sources(double oversampling, std::span<const double> a,
                                     std::span<const double> b, std::span<const Complex> c,
                                     double cells_per_radian, int64_t first_x, int64_t first_y,
                                     int64_t stride, std::span<Complex *const> planes) {
    static const KernelPolynomials<W> of_fine(beta_for(W, fine)), of_coarse(beta_for(W, coarse));
    const KernelPolynomials<W> &polynomials = oversampling == fine ? of_fine : of_coarse;
    std::vector<double> column;
    for (size_t begin = 0, end = 0; begin < a.size(); begin = end) {
        int64_t low = Place<W>(b[begin], cells_per_radian).cell, high = low;
        for (end = begin + 1; end < a.size() && a[end] == a[begin]; ++end) {
            const int64_t cell = Place<W>(b[end], cells_per_radian).cell;
            low = std::min(low, cell);
            high = std::max(high, cell);
        }
        const Place<W> x(a[begin], cells_per_radian);
        const AlongAxis<W> along_x(polynomials, x.offset);
        constexpr size_t few = 4;
        if (end - begin < few) {
            for (size_t i = begin; i < end; ++i) {
                const Place<W> y(b[i], cells_per_radian);
                const AlongAxis<W> along_y(polynomials, y.offset);
                const int64_t at = (y.cell - first_y) * stride + x.cell - first_x;
                for (size_t plane = 0; plane < planes.size(); ++plane) {
                    const Complex source = c[plane * a.size() + i];
                    Complex *cells = planes[plane] + at;
                    for (size_t j = 0; j < W; ++j, cells += stride)
                        along_x.add(along_y.weights[j] * source.real(),
                                    along_y.weights[j] * source.imag(),
                                    reinterpret_cast<double *>(cells));
                }
            }
            continue;
        }
        const size_t used = static_cast<size_t>(high - low) + AlongAxis<W>::padded;
        column.assign(2 * used * planes.size(), 0);
        for (size_t i = begin; i < end; ++i) {
            const Place<W> y(b[i], cells_per_radian);
            const AlongAxis<W> along_y(polynomials, y.offset);
            double *re = &column[static_cast<size_t>(y.cell - low)];
            for (size_t plane = 0; plane < planes.size(); ++plane, re += 2 * used) {
                const Complex source = c[plane * a.size() + i];
                along_y.add(source.real(), re);
                along_y.add(source.imag(), re + used);
            }
        }
        const double *re = column.data();
        for (Complex *const plane : planes) {
            Complex *cells = plane + (low - first_y) * stride + x.cell - first_x;
            for (size_t j = 0; j <= static_cast<size_t>(high - low) + W - 1; ++j, cells += stride)
                along_x.add(re[j], re[j + used], reinterpret_cast<double *>(cells));
            re += 2 * used;
        }
    }
}

template <int W = narrowest, class... Arguments>
void spread_width(int width, Arguments &&...arguments) {
    if constexpr (W < widest)
        if (width > W)
            return spread_width<W + 1>(width, arguments...);
    spread_sources<W>(arguments...);
}

void add_cells(const Complex *from, int64_t count, Complex *to) {
    for (int64_t i = 0; i < count; ++i)
        to[i] += from[i];
}

// Calls part(i, j, length) for the runs of cells i.. that stand at j.. of a period of n.
template <class Part> void in_period(int64_t first, int64_t count, int64_t n, const Part &part) {
    for (int64_t i = 0; i < count;) {
        const int64_t j = (((first + i) % n) + n) % n;
        const int64_t length = std::min(count - i, n - j);
        part(i, j, length);
        i += length;
    }
}

} // namespace

Type1Transform::Axis::Axis(Band band, int64_t cells, int width) : n(cells) {
    const auto cell = [&](double angle) {
        return static_cast<int64_t>(
            std::floor(angle * (static_cast<double>(n) / (2 * pi)) - width / 2.0));
    };
    // A cell to spare at either end, for roundings of the band.
    first = cell(band.low);
    used = cell(band.high) + width + 2 - first;
}

Type1Transform::Type1Transform(Band a, Band b, int64_t K, double eps, size_t count)
    : K_(K), oversampling_(oversampling_for(eps)), width_(width_for(eps)),
      x_(a, fine_cells(K, width_, oversampling_), width_), y_(b, x_.n, width_),
      correction_(kernel_correction(width_, beta_for(width_, oversampling_), K, x_.n)),
      stride_((x_.used + batch - 1) / batch * batch) {
    while (cells_.size() < count)
        cells_.emplace_back(static_cast<size_t>(stride_ * y_.used + batch), Complex(0));
}

Type1Transform::Memory Type1Transform::memory(Band a, Band b, int64_t K, double eps) {
    const int width = width_for(eps);
    const Axis x(a, fine_cells(K, width, oversampling_for(eps)), width), y(b, x.n, width);
    const auto size = static_cast<int64_t>(sizeof(Complex));
    // Beside the cells, the columns or rows that are transformed together.
    return {size * ((x.used + batch) * (y.used + 1) + 2 * x.n * (batch + 1)),
            size * (x.used + batch)};
}

void Type1Transform::add(std::span<const double> a, std::span<const double> b,
                         std::span<const Complex> c) {
    std::vector<Complex *> planes;
    for (Cells &cells : cells_)
        planes.push_back(cells.data());
    spread_width(width_, oversampling_, a, b, c, static_cast<double>(x_.n) / (2 * pi), x_.first,
                 y_.first, stride_, std::span<Complex *const>(planes));
}

// Modes first..last along y of every column of cells, divided by the kernel's transform.
Type1Transform::Cells Type1Transform::transform_columns(const Cells &cells, int64_t first,
                                                        int64_t last) const {
    const int64_t n = y_.n;
    const BackwardFft fft(n, batch);
    Cells half(static_cast<size_t>((last - first + 1) * stride_));
    Cells period(static_cast<size_t>(n * batch));
    for (int64_t x = 0; x < stride_; x += batch) {
        std::fill(period.begin(), period.end(), Complex(0));
        in_period(y_.first, y_.used, n, [&](int64_t cell, int64_t at, int64_t length) {
            for (int64_t y = 0; y < length; ++y)
                add_cells(&cells[static_cast<size_t>((cell + y) * stride_ + x)], batch,
                          &period[static_cast<size_t>((at + y) * batch)]);
        });
        fft.run(period.data());
        in_period(first, last - first + 1, n, [&](int64_t row, int64_t at, int64_t length) {
            for (int64_t k = row; k < row + length; ++k) {
                const double factor = correction_[static_cast<size_t>(K_ + first + k)];
                const Complex *from = &period[static_cast<size_t>((at + k - row) * batch)];
                Complex *to = &half[static_cast<size_t>(k * stride_ + x)];
                for (int64_t i = 0; i < batch; ++i)
                    to[i] = factor * from[i];
            }
        });
    }
    return half;
}

void Type1Transform::rows(int64_t first, int64_t last, const RowSink &row, size_t which) const {
    const Cells half = transform_columns(cells_[which], first, last);
    const int64_t n = x_.n, length = 2 * K_ + 1;
    const BackwardRowFfts ffts(n, batch);
    Cells periods(static_cast<size_t>(n * batch)), modes(static_cast<size_t>(length));
    for (int64_t begin = first; begin <= last; begin += batch) {
        const int64_t count = std::min(batch, last + 1 - begin);
        std::fill(periods.begin(), periods.end(), Complex(0));
        for (int64_t j = 0; j < count; ++j) {
            const Complex *cells = &half[static_cast<size_t>((begin + j - first) * stride_)];
            in_period(x_.first, x_.used, n, [&](int64_t cell, int64_t at, int64_t run) {
                add_cells(cells + cell, run, &periods[static_cast<size_t>(j * n + at)]);
            });
        }
        ffts.run(periods.data());
        for (int64_t j = 0; j < count; ++j) {
            in_period(-K_, length, n, [&](int64_t mode, int64_t at, int64_t run) {
                const Complex *from = &periods[static_cast<size_t>(j * n + at)];
                for (int64_t i = 0; i < run; ++i)
                    modes[static_cast<size_t>(mode + i)] =
                        correction_[static_cast<size_t>(mode + i)] * from[i];
            });
            row(begin + j, modes);
        }
    }
}

} // namespace wfpsf
