// SPDX-License-Identifier: GPL-3.0-or-later
// Transforms of FFTW3 in one and two dimensions, planned once per shape.
#pragma once

#include <complex>
#include <cstdint>
#include <mutex>

namespace wfpsf {

// The smallest length >= n that FFTW transforms fast: 2^a 3^b 5^c 7^d, beyond 16 a multiple of four,
// with at least one factor that is not 2, because long powers of two collide in the cache.
int64_t good_fft_length(int64_t n);

// FFTW's planner is not safe for threads: plans are made and destroyed under this lock.
std::mutex &fftw_planner_lock();

// Plans are made under one lock for the whole process, by estimate, so that equal calls give equal
// bits; running them needs no lock.
class PlannedFft {
  public:
    void run(std::complex<double> *data) const;

  protected:
    explicit PlannedFft(void *plan) : plan_(plan) {}
    void *plan() const { return plan_; }

  private:
    void *plan_; // fftw_plan, owned by the cache
};

// out[k] = sum_l in[l] exp(+2 pi i k l / n), in place, unnormalised, for `batch` sequences side by
// side: element l of sequence s is data[l * batch + s].
class BackwardFft : public PlannedFft {
  public:
    explicit BackwardFft(int64_t n, int64_t batch = 1);
};

// The same for sequences one after another.
class BackwardRowFfts : public PlannedFft {
  public:
    BackwardRowFfts(int64_t n, int64_t count);
};

// The same in two dimensions, over nx by ny numbers, x fastest.
class BackwardFft2d : public PlannedFft {
  public:
    BackwardFft2d(int64_t nx, int64_t ny);
};

// The same for numbers whose transform is real: of the input, rows of nx / 2 + 1 numbers, the rest
// is their mirror image. Destroys its input.
class RealBackwardFft2d : private PlannedFft {
  public:
    RealBackwardFft2d(int64_t nx, int64_t ny);
    void run(std::complex<double> *in, double *out) const;
};

} // namespace wfpsf
