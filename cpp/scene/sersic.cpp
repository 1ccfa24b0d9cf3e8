// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/sersic.hpp"

#include "error/error.hpp"
#include "numerics/gamma.hpp"
#include "scene/hankel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;

// The regularised incomplete gamma function P(a, x): a series, and a continued fraction by Lentz's
// method where that converges slowly (Numerical Recipes, section 6.2).
double incomplete_gamma(double a, double x) {
    if (x <= 0)
        return 0;
    const double front = std::exp(a * std::log(x) - x - log_of_gamma(a));
    constexpr double small = std::numeric_limits<double>::epsilon() / 4;
    if (x < a + 1) {
        double term = 1 / a, sum = term;
        for (double k = a + 1; term > small * sum; ++k) {
            term *= x / k;
            sum += term;
        }
        return front * sum;
    }
    if (front == 0)
        return 1;
    double b = x + 1 - a, c = HUGE_VAL, d = 1 / b, fraction = d;
    for (double i = 1;; ++i) {
        const double numerator = -i * (i - a);
        b += 2;
        d = 1 / (numerator * d + b);
        c = b + numerator / c;
        fraction *= c * d;
        if (std::abs(c * d - 1) < 4 * small)
            return 1 - front * fraction;
    }
}

// P(2n, b) = 1/2, by Newton's method.
double half_light(double n) {
    double b = 2 * n - 1.0 / 3 + 0.01 / n;
    for (int i = 0; i < 20; ++i) {
        const double slope = std::exp((2 * n - 1) * std::log(b) - b - log_of_gamma(2 * n));
        const double change = (incomplete_gamma(2 * n, b) - 0.5) / slope;
        b -= change;
        if (std::abs(change) < 4 * std::numeric_limits<double>::epsilon() * b)
            break;
    }
    return b;
}

double checked(double index) {
    if (!(index >= Sersic::smallest_index && index <= Sersic::largest_index))
        fail(WFPSF_ERROR_RANGE, "sersic_index = %g: must be %g..%g", index, Sersic::smallest_index,
             Sersic::largest_index);
    return index;
}

// The polynomial through values at nodes, by Newton's divided differences.
template <size_t n>
std::array<double, n> interpolate(const std::array<double, n> &nodes,
                                  std::array<double, n> values) {
    for (size_t order = 1; order < n; ++order)
        for (size_t i = n; i-- > order;)
            values[i] = (values[i] - values[i - 1]) / (nodes[i] - nodes[i - order]);
    std::array<double, n> c{};
    for (size_t i = n; i-- > 0;) {
        for (size_t j = n; j-- > 1;)
            c[j] = c[j - 1] - nodes[i] * c[j];
        c[0] = values[i] - nodes[i] * c[0];
    }
    return c;
}

} // namespace

SersicTable::SersicTable(double n, double b, double mean_square_radius) {
    constexpr size_t intervals = 1 << bits; // an octave
    std::array<double, terms> nodes;
    for (size_t i = 0; i < terms; ++i)
        nodes[i] = std::cos(pi * (static_cast<double>(i) + 0.5) / terms) / 2;

    // F = 1 - q <r^2> / 4 + ...: what is below counts as one.
    const int lowest = std::ilogb(0.2 * error / mean_square_radius);
    lowest_ = std::ldexp(1.0, lowest);
    first_ = std::bit_cast<uint64_t>(lowest_) >> (52 - bits);
    const SersicHankel hankel(n, b);
    double integral = 0;
    // Two octaves of nothing are the end: one may hold a zero.
    for (int octave = lowest, faint = 0; faint < 2; ++octave) {
        std::array<double, terms * intervals> logs, values;
        for (size_t i = 0; i < logs.size(); ++i) {
            const size_t eighth = i / terms;
            const double place = static_cast<double>(eighth) + 0.5 + nodes[i % terms];
            logs[i] = std::log(std::ldexp(1 + place / intervals, octave)) / 2;
        }
        hankel.at(logs, values.data());
        double largest = 0;
        for (size_t i = 0; i < intervals; ++i) {
            std::array<double, terms> here;
            std::copy_n(values.data() + terms * i, terms, here.data());
            double most = 0;
            for (const double value : here)
                most = std::max(most, std::abs(value));
            const std::array<double, terms> polynomial = interpolate(nodes, here);
            coefficients_.insert(coefficients_.end(), polynomial.begin(), polynomial.end());
            integral_.push_back(integral);
            integral += most * std::ldexp(0.5 / intervals, octave);
            largest = std::max(largest, most);
        }
        highest_ = std::ldexp(1.0, octave + 1);
        faint = largest < 0.1 * error ? faint + 1 : 0;
    }
    coefficients_.insert(coefficients_.end(), terms, 0.0);
    integral_.push_back(integral);
}

size_t SersicTable::interval(double q) const {
    const double inside = std::clamp(q, lowest_, highest_);
    return static_cast<size_t>((std::bit_cast<uint64_t>(inside) >> (52 - bits)) - first_);
}

double SersicTable::absolute_integral(double from, double to) const {
    const size_t last = std::min(interval(to * to) + 1, integral_.size() - 1);
    return integral_[last] - integral_[interval(from * from)];
}

Sersic::Sersic(double index)
    : index_(checked(index)), b_(half_light(index)),
      centre_(std::exp(2 * index * std::log(b_) - log_of_gamma(2 * index)) / (2 * pi * index)),
      mean_square_radius_(
          std::exp(log_of_gamma(4 * index) - log_of_gamma(2 * index) - 2 * index * std::log(b_))),
      table_(index, b_, mean_square_radius_) {}

double Sersic::brightness(double r) const {
    return centre_ * std::exp(-b_ * std::pow(r, 1 / index_));
}

double Sersic::radius_of(double brightness) const {
    return brightness < centre_ ? std::pow(std::log(centre_ / brightness) / b_, index_) : 0;
}

double Sersic::enclosed(double r) const {
    return incomplete_gamma(2 * index_, b_ * std::pow(r, 1 / index_));
}

const Sersic &SersicProfiles::of(double index) {
    const auto found = profiles_.find(index);
    return found != profiles_.end() ? found->second
                                    : profiles_.try_emplace(index, index).first->second;
}

} // namespace wfpsf
