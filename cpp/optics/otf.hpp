// SPDX-License-Identifier: GPL-3.0-or-later
// The optical transfer function: the Fourier transform of the PSF, by the autocorrelation of the
// pupil function (Goodman, Introduction to Fourier Optics, section 6.3).
#pragma once

#include "image/view.hpp"
#include "optics/blur.hpp"
#include "optics/component.hpp"

#include <complex>
#include <cstdint>
#include <span>
#include <vector>

namespace wfpsf {

// Immutable once made.
//
//     OTF(k) = integral of I(theta) exp(-2 pi i k . theta) d2theta / the same at k = 0
//            = integral of f(u) conj f(u - lambda k) d2u / the same at k = 0,
//
// f the pupil function: transmission times exp(2 pi i W). It is averaged on square pixels. Shifts
// by whole pixels are summed by FFT, others interpolated. A pupil that is a mask has such pixels
// from the start; its autocorrelation is bilinear in between and comes out exactly.
class Otf {
  public:
    static constexpr int64_t most_pixels = 2048; // across a pupil given as geometry

    // `eps` bounds the error of a PSF made of the OTF, in units of its peak: the integral of the
    // OTF's error over that of the OTF. Single values have a larger error where the OTF has a kink:
    // near k = 0, and for shifts along straight edges.
    // `pixel_scale` is the native pixel's side, radians; mirrored, blur and pixel_response as in
    // PsfSettings.
    Otf(std::span<const Component> components, double pixel_scale, bool mirrored, double eps,
        const Covariance &blur = {}, bool pixel_response = true);

    // By diffraction alone; k in cycles per radian. Zero beyond the cut-off.
    std::complex<double> diffraction(double kx, double ky) const;

    // The same times what else acts on the image before it is sampled: the native pixel, jitter and
    // diffusion.
    std::complex<double> effective(double kx, double ky) const;

    double cutoff() const { return cutoff_; }           // of |kx| and |ky|, cycles per radian
    double error_estimate() const { return error_; }    // as eps
    double value_error() const { return value_error_; } // estimate of the largest one
    int64_t pixels() const { return pixels_; }          // across the pupil

  private:
    // The autocorrelation for shifts of whole pixels along x and y; those with y < 0 are conjugate.
    struct Lattice {
        Plane<std::complex<double>> value; // framed by a margin
        int64_t width;                     // of the pupil, pixels: zero from there on
        double pixels_per_k;               // shift in pixels of one cycle per radian
        double weight;
        double blur; // what the pixels' edges take from the light at shift 0
        bool exact;
        std::complex<double> at(double x, double y) const;
    };
    Otf() = default;
    static Lattice autocorrelation(const Component &component, int64_t n);
    void make(std::span<const Component> components, int64_t n);
    void estimate(std::span<const Component> components, int64_t n);

    std::vector<Lattice> lattices_;
    bool mirrored_ = false, pixel_response_ = true, exact_ = true;
    double pixel_scale_ = 0;
    Covariance blur_; // native pixels^2
    double cutoff_ = 0, error_ = 0, value_error_ = 0;
    int64_t pixels_ = 0;
};

} // namespace wfpsf
