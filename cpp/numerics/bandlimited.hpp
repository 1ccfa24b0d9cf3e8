// SPDX-License-Identifier: GPL-3.0-or-later
// Interpolation and filtering of band-limited samples by a windowed sinc.
#pragma once

#include <cstdint>
#include <vector>

namespace wfpsf {

// Interpolates samples at unit steps of a function with no content above `bandwidth` cycles per
// sample, 0 < bandwidth < 1/2. The error is at most error() times the integral of the absolute
// value of the function's spectrum (for a function with a positive spectrum: its largest value).
//
// The kernel is sinc(t) exp(b (sqrt(1 - (t/H)^2) - 1)) on |t| < H: its transform is one on the band
// and zero on all of the band's images but for exp(-b), if b = 2 pi H (1/2 - bandwidth).
class BandlimitedInterpolator {
  public:
    BandlimitedInterpolator(double bandwidth, double eps);

    double bandwidth() const { return bandwidth_; }
    int half_width() const { return half_width_; }
    int taps() const { return 2 * half_width_; }
    double error() const { return error_; }

    // The kernel at a distance of t samples.
    double kernel(double t) const;

    // The weights of the samples around position x: w[0 .. taps()). Returns the first sample's
    // index.
    int64_t weights(double x, double *w) const;

    // The symmetric filter of unit steps that also averages over a window of the given width (in
    // samples): taps f[0 .. 2m], centre f[m].
    std::vector<double> averaging_filter(double width) const;

  private:
    double bandwidth_;
    int half_width_;
    double beta_, error_;
};

} // namespace wfpsf
