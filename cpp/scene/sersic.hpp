// SPDX-License-Identifier: GPL-3.0-or-later
// Sersic profiles, I(r) ~ exp(-b r^(1/n)), r in units of the half-light radius (Sersic 1963; Ciotti
// and Bertin 1999, Astron. Astrophys. 352, 447): untruncated, of unit flux. The Gaussian is
// n = 0.5, the exponential 1, de Vaucouleurs' 4.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace wfpsf {

// The Fourier transform F of a profile as a function of q = k^2 (k in radians per half-light
// radius): polynomials on eighths of octaves, so that an index is a few bits of q.
class SersicTable {
  public:
    SersicTable(double n, double b, double mean_square_radius);

    static constexpr double error = 1e-9; // absolute, of F; a test holds it against other methods

    // Any q >= 0. Apart from its table, for loops that become vector instructions.
    class Lookup;
    Lookup lookup() const;

    // The largest integral of |F| k dk from wave number `from` to `to`, k <= what q holds.
    double absolute_integral(double from, double to) const;
    double highest() const { return highest_; } // of q; F is zero from there on

  private:
    static constexpr int bits = 3;
    static constexpr size_t terms = 6;

    size_t interval(double q) const;

    uint64_t first_;
    double lowest_, highest_;
    std::vector<double> coefficients_;
    std::vector<double> integral_; // of |F| k dk up to the start of each interval, rounded up
};

class SersicTable::Lookup {
  public:
    [[gnu::always_inline]] double operator()(double q) const {
        q = q < lowest_ ? lowest_ : q;
        q = q > highest_ ? highest_ : q;
        const auto word = std::bit_cast<uint64_t>(q);
        const double *c = coefficients_ + terms * ((word >> (52 - bits)) - first_);
        const uint64_t fraction = (word << bits) & 0x000fffffffffffff;
        const double t = std::bit_cast<double>(fraction | 0x3ff0000000000000) - 1.5;
        return c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5]))));
    }

  private:
    friend class SersicTable;
    Lookup(const double *coefficients, uint64_t first, double lowest, double highest)
        : coefficients_(coefficients), first_(first), lowest_(lowest), highest_(highest) {}

    const double *coefficients_;
    uint64_t first_;
    double lowest_, highest_;
};

inline SersicTable::Lookup SersicTable::lookup() const {
    return {coefficients_.data(), first_, lowest_, highest_};
}

class Sersic {
  public:
    static constexpr double smallest_index = 0.3, largest_index = 6.2;

    // WFPSF_ERROR_RANGE if the index is not in that range. Takes about a millisecond.
    explicit Sersic(double index);

    double index() const { return index_; }
    double b() const { return b_; }    // to double precision
    double brightness(double r) const; // light per area
    // Where the brightness falls to that; 0 if it never is so large.
    double radius_of(double brightness) const;
    double enclosed(double r) const; // fraction of the light
    double mean_square_radius() const { return mean_square_radius_; }

    // F(k) = integral of I(r) J0(k r) 2 pi r dr.
    double transform(double k) const { return table_.lookup()(k * k); }
    const SersicTable &table() const { return table_; }

  private:
    double index_, b_, centre_, mean_square_radius_;
    SersicTable table_;
};

// Profiles that are used again and again.
class SersicProfiles {
  public:
    const Sersic &of(double index);

  private:
    std::map<double, Sersic> profiles_;
};

} // namespace wfpsf
