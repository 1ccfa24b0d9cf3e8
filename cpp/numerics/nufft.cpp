// SPDX-License-Identifier: GPL-3.0-or-later
#include "numerics/nufft.hpp"

#include "numerics/dispatch.hpp"
#include "numerics/fft.hpp"
#include "numerics/quadrature.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;
using Complex = std::complex<double>;

constexpr int narrowest = 4, widest = 16; // kernel widths, fine grid cells

// The spreading kernel exp(beta (sqrt(1 - z^2) - 1)), |z| < 1, over `width` cells of a grid twice
// as fine as the modes need.
double kernel(double beta, double z) {
    return std::abs(z) < 1 ? std::exp(beta * (std::sqrt(1 - z * z) - 1)) : 0;
}

int width_for(double eps) {
    const double digits = -std::log10(std::max(eps, nufft_best_eps));
    return std::clamp(static_cast<int>(std::ceil(digits + 1.4)), narrowest, widest);
}

double beta_for(int width) {
    return 2.3 * width;
}

// The transform of the kernel at modes 0..K of a fine grid of n cells.
std::vector<double> kernel_transform(int width, int64_t K, int64_t n) {
    const GaussLegendre rule(2 * width + 12);
    const double beta = beta_for(width), half = width / 2.0;
    std::vector<double> transform(static_cast<size_t>(K + 1));
    for (size_t i = 0; i < rule.x.size(); ++i) {
        const double weight = rule.w[i] * half * kernel(beta, rule.x[i]);
        const double angle = 2 * pi * half * rule.x[i] / static_cast<double>(n);
        for (size_t k = 0; k < transform.size(); ++k)
            transform[k] += weight * std::cos(angle * static_cast<double>(k));
    }
    return transform;
}

// The kernel at all W cells around a source, as one polynomial a cell in the source's offset
// within its cell: coefficients fitted through Chebyshev's points.
template <int W> class KernelPolynomials {
  public:
    KernelPolynomials() {
        constexpr int n = degree + 1;
        const double beta = beta_for(W);
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

    // Values at cells 0..W-1 for a source at offset z in [-1, 1] of half a cell.
    [[gnu::always_inline]] void evaluate(double z, double *values) const {
        for (int cell = 0; cell < W; ++cell)
            values[cell] = coefficients_[degree][static_cast<size_t>(cell)];
        for (size_t k = degree; k-- > 0;)
            for (int cell = 0; cell < W; ++cell)
                values[cell] = values[cell] * z + coefficients_[k][static_cast<size_t>(cell)];
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

    std::array<std::array<double, W>, degree + 1> coefficients_;
};

// One axis of the fine grid: which cells the sources reach, and the scale.
struct Axis {
    int64_t n;           // cells in a period
    int64_t first, used; // cells that the sources touch

    Axis(std::span<const double> angles, int64_t cells, int width) : n(cells) {
        const auto [low, high] = std::minmax_element(angles.begin(), angles.end());
        first = cell(*low, width);
        used = cell(*high, width) + width - first;
    }
    double scaled(double angle) const { return angle * static_cast<double>(n) / (2 * pi); }
    // The first of the cells that a source at this angle is spread over.
    int64_t cell(double angle, int width) const {
        return static_cast<int64_t>(std::floor(scaled(angle) - width / 2.0)) + 1;
    }
};

// Sums the sources onto the cells that they touch: grid[y * x.used + x].
template <int W>
WFPSF_VECTORISED std::vector<Complex> spread(std::span<const double> a, std::span<const double> b,
                                             std::span<const Complex> c, const Axis &x,
                                             const Axis &y) {
    const KernelPolynomials<W> polynomials;
    std::vector<Complex> grid(static_cast<size_t>(x.used * y.used));
    for (size_t i = 0; i < c.size(); ++i) {
        const int64_t cell_x = x.cell(a[i], W), cell_y = y.cell(b[i], W);
        const auto offset = [](double scaled, int64_t cell) {
            return 2 * (scaled - static_cast<double>(cell) - (W - 1) / 2.0);
        };
        double along_x[W], along_y[W], row[2 * W];
        polynomials.evaluate(offset(x.scaled(a[i]), cell_x), along_x);
        polynomials.evaluate(offset(y.scaled(b[i]), cell_y), along_y);
        for (int k = 0; k < W; ++k) {
            row[2 * k] = c[i].real() * along_x[k];
            row[2 * k + 1] = c[i].imag() * along_x[k];
        }
        auto *cells = reinterpret_cast<double *>(
            &grid[static_cast<size_t>((cell_y - y.first) * x.used + cell_x - x.first)]);
        for (int j = 0; j < W; ++j, cells += 2 * x.used)
            for (int k = 0; k < 2 * W; ++k)
                cells[k] += along_y[j] * row[k];
    }
    return grid;
}

template <int W = narrowest>
std::vector<Complex> spread_width(int width, std::span<const double> a, std::span<const double> b,
                                  std::span<const Complex> c, const Axis &x, const Axis &y) {
    if constexpr (W < widest)
        if (width > W)
            return spread_width<W + 1>(width, a, b, c, x, y);
    return spread<W>(a, b, c, x, y);
}

// Transforms every row of `lines` x axis.used cells to modes -K..K, divides by the kernel's
// transform and writes the result transposed: out[mode * lines + line].
void transform_rows(const Complex *rows, int64_t lines, const Axis &axis, int64_t K,
                    const std::vector<double> &kernel_modes, Complex *out) {
    const BackwardFft fft(axis.n);
    std::vector<Complex> period(static_cast<size_t>(axis.n));
    const auto wrapped = [&axis](int64_t i) {
        return static_cast<size_t>(((i % axis.n) + axis.n) % axis.n);
    };
    for (int64_t line = 0; line < lines; ++line) {
        std::fill(period.begin(), period.end(), Complex(0));
        for (int64_t i = 0; i < axis.used; ++i)
            period[wrapped(axis.first + i)] += rows[line * axis.used + i];
        fft.run(period.data());
        for (int64_t k = -K; k <= K; ++k)
            out[(k + K) * lines + line] =
                period[wrapped(k)] / kernel_modes[static_cast<size_t>(std::abs(k))];
    }
}

} // namespace

void nufft_type1(std::span<const double> a, std::span<const double> b, std::span<const Complex> c,
                 int64_t K, double eps, Complex *out) {
    const int64_t modes = 2 * K + 1;
    if (c.empty()) {
        std::fill_n(out, modes * modes, Complex(0));
        return;
    }
    const int width = width_for(eps);
    const int64_t n = good_fft_length(std::max<int64_t>(2 * modes, 2 * width));
    const std::vector<double> kernel_modes = kernel_transform(width, K, n);
    const Axis x(a, n, width), y(b, n, width);
    const std::vector<Complex> grid = spread_width(width, a, b, c, x, y);
    // Along x first: rows of cells in y become columns, so that the second pass restores the order.
    std::vector<Complex> half(static_cast<size_t>(modes * y.used));
    transform_rows(grid.data(), y.used, x, K, kernel_modes, half.data());
    transform_rows(half.data(), modes, y, K, kernel_modes, out);
}

} // namespace wfpsf
