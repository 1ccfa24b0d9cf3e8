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
    BandlimitedInterpolator() = default; // of no width
    BandlimitedInterpolator(double bandwidth, double eps);

    int half_width() const { return half_width_; }
    int taps() const { return 2 * half_width_; }
    double error() const { return error_; }

    // The kernel at a distance of t samples.
    double kernel(double t) const;

    // The weights of the samples around position x: w[0 .. taps()). Returns the first sample's
    // index.
    int64_t weights(double x, double *w) const;

    // The symmetric filter of unit steps that also averages over a window of the given width (in
    // samples; 0: nothing is averaged): taps f[0 .. 2m], centre f[m].
    std::vector<double> averaging_filter(double width) const;

    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.half_width_, self.beta_, self.error_);
    }

  private:
    friend class AveragedSamples;
    BandlimitedInterpolator(int half_width, double beta) : half_width_(half_width), beta_(beta) {}

    int half_width_ = 0;
    double beta_ = 0, error_ = 0;
};

// What bounds the spectrum of an intensity behind an aperture of given extent along both axes: the
// outline that the aperture fits in, a square or an ellipse.
enum class Outline { square, round };

// The largest |A|^2 in units of area^2 there can be, if all of the outline were lit. The bound on
// the spectrum is as many times that of the outline, scaled to an integral of one.
double outline_strength(Outline outline, double extent, double area);

// The two filters that a native pixel's samples need: the average over `width` samples (0: none),
// and the interpolation of what that gives. The spectrum of the intensity runs out at the band's
// edge: so both may cut deeper into the band than for a spectrum of any shape, and are shorter.
class AveragedSamples {
  public:
    // error() <= eps, where rounding allows it.
    AveragedSamples(double bandwidth, double width, Outline outline, double eps);

    const BandlimitedInterpolator &interpolator() const { return interpolator_; }
    const std::vector<double> &averaging() const { return averaging_; } // taps 0..2m, centre m

    // Bounds the error of all passes, two along each axis: what the filters miss, in units of
    // outline_strength(), and the rounding of the sums, of the largest sample.
    double missed() const { return missed_; }
    static constexpr double rounding = 4e-15;
    double error() const { return missed_ + rounding; } // where both units are the same

  private:
    BandlimitedInterpolator interpolator_;
    std::vector<double> averaging_;
    double missed_ = 0;
};

} // namespace wfpsf
