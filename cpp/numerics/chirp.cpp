// SPDX-License-Identifier: GPL-3.0-or-later
#include "numerics/chirp.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wfpsf {

namespace {

// exp(sign pi i turns x^2): thousands of turns, of which only the fraction counts.
std::complex<double> chirp(double sign, double turns, double x) {
    const long double whole = static_cast<long double>(turns) * x * x / 2;
    const auto part = static_cast<double>(whole - std::rint(whole));
    return std::polar(1.0, sign * 2 * std::numbers::pi * part);
}

} // namespace

ChirpTransform::ChirpTransform(int64_t inputs, int64_t outputs, double turns)
    : inputs_(inputs), length_(good_fft_length(inputs + outputs - 1)), fft_(length_, batch),
      response_(static_cast<size_t>(length_)) {
    const double middle_in = static_cast<double>(inputs - 1) / 2;
    const double middle_out = static_cast<double>(outputs - 1) / 2;
    for (int64_t n = 0; n < inputs; ++n)
        chirp_.push_back(chirp(1, turns, static_cast<double>(n) - middle_in));
    for (int64_t m = 1 - inputs; m < outputs; ++m)
        response_[static_cast<size_t>(m < 0 ? m + length_ : m)] =
            chirp(-1, turns, static_cast<double>(m) + middle_in - middle_out);
    BackwardFft(length_).run(response_.data());
    for (std::complex<double> &r : response_)
        r /= static_cast<double>(length_);
}

void ChirpTransform::run(std::vector<std::complex<double>> &buffer) const {
    const auto multiply = [&buffer](const std::vector<std::complex<double>> &factors) {
        for (size_t n = 0; n < factors.size(); ++n)
            for (size_t s = 0; s < batch; ++s) {
                std::complex<double> &value = buffer[n * batch + s];
                const double re = value.real(), im = value.imag();
                value = {re * factors[n].real() - im * factors[n].imag(),
                         re * factors[n].imag() + im * factors[n].real()};
            }
    };
    multiply(chirp_);
    std::fill(buffer.begin() + inputs_ * batch, buffer.end(), 0);
    fft_.run(buffer.data());
    multiply(response_);
    fft_.run(buffer.data()); // a second one the same way turns the order round: place()
}

} // namespace wfpsf
