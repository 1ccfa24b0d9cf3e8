// SPDX-License-Identifier: GPL-3.0-or-later
// One-dimensional transforms of FFTW3, planned once per length.
#pragma once

#include <complex>
#include <cstdint>
#include <mutex>

namespace wfpsf {

// The smallest length >= n that FFTW transforms fast: 2^a 3^b 5^c 7^d with at least one factor that
// is not 2, because long powers of two collide in the cache.
int64_t good_fft_length(int64_t n);

// FFTW's planner is not safe for threads: plans are made and destroyed under this lock.
std::mutex &fftw_planner_lock();

// sum_l in[l] exp(+2 pi i k l / n), in place, unnormalised. Plans are made under one lock for the
// whole process, by estimate, so that equal calls give equal bits; running them needs no lock.
class BackwardFft {
  public:
    explicit BackwardFft(int64_t n);
    void run(std::complex<double> *data) const;

  private:
    void *plan_; // fftw_plan, owned by the cache
};

} // namespace wfpsf
