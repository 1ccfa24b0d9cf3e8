// SPDX-License-Identifier: GPL-3.0-or-later
// Discrete Fourier transforms at any step (Bluestein 1970, IEEE Trans. Audio Electroacoust. 18,
// 451): n j = (n^2 + j^2 - (j - n)^2) / 2 makes of the sum a convolution, done by FFT. Exact but
// for rounding.
#pragma once

#include "numerics/fft.hpp"

#include <complex>
#include <cstdint>
#include <vector>

namespace wfpsf {

// out[j] = sum_n in[n] exp(2 pi i turns (n - (inputs - 1) / 2) (j - (outputs - 1) / 2)), but for a
// phase of each j that is the same for all sequences: for those who want moduli.
class ChirpTransform {
  public:
    static constexpr int64_t batch = 16; // sequences transformed side by side

    ChirpTransform(int64_t inputs, int64_t outputs, double turns);

    // Room for `batch` sequences: element n of sequence s is buffer()[n * batch + s].
    std::vector<std::complex<double>> buffer() const {
        return std::vector<std::complex<double>>(static_cast<size_t>(length_ * batch));
    }
    // In place; whatever stands in the buffer beyond the inputs is overwritten. Output j of
    // sequence s is then buffer[place(j) * batch + s].
    void run(std::vector<std::complex<double>> &buffer) const;
    int64_t place(int64_t j) const { return j == 0 ? 0 : length_ - j; }

  private:
    int64_t inputs_, length_;
    BackwardFft fft_;
    std::vector<std::complex<double>> chirp_;    // of the inputs
    std::vector<std::complex<double>> response_; // transform of the chirp they are convolved with
};

} // namespace wfpsf
