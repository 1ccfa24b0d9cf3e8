// SPDX-License-Identifier: GPL-3.0-or-later
// Transforms of FFTW3 in one and two dimensions, planned once per size.
#pragma once

#include <complex>
#include <cstdint>

namespace wfpsf {

// The smallest length >= n that FFTW transforms fast: 2^a 3^b 5^c 7^d with at least one factor that
// is not 2, because long powers of two collide in the cache.
int64_t good_fft_length(int64_t n);

// sum_l in[l] exp(+2 pi i k l / n), in place, unnormalised; in two dimensions over nx by ny
// numbers, x fastest. Plans are made under one lock for the whole process, by estimate, so that
// equal calls give equal bits; running them needs no lock.
class BackwardFft {
  public:
    explicit BackwardFft(int64_t n) : BackwardFft(n, 1) {}
    BackwardFft(int64_t nx, int64_t ny);
    void run(std::complex<double> *data) const;

  private:
    void *plan_; // fftw_plan, owned by the cache
};

} // namespace wfpsf
