// SPDX-License-Identifier: GPL-3.0-or-later
// From the pupil to the focal plane: the transforms that the PSF engine uses, against the matrix
// product that gives the same amplitude (Soummer et al. 2007, Opt. Express 15, 15935). The error is
// that of the amplitude against the product's, in units of the sum of all sources.
#include "harness.hpp"
#include "numerics/chirp.hpp"
#include "numerics/nufft.hpp"
#include "oracles/psf_oracle.hpp"

#include <algorithm>
#include <complex>
#include <cstdio>
#include <random>

#include <Eigen/Dense>

namespace wfpsf::bench {

namespace {

using Complex = std::complex<double>;

// exp(i angle_n j), j = -K..K: a row for each source.
Eigen::MatrixXcd waves(const std::vector<double> &angles, int64_t K) {
    Eigen::MatrixXcd out(static_cast<Eigen::Index>(angles.size()), 2 * K + 1);
    for (Eigen::Index n = 0; n < out.rows(); ++n)
        for (Eigen::Index j = 0; j < out.cols(); ++j)
            out(n, j) =
                std::polar(1.0, angles[static_cast<size_t>(n)] * static_cast<double>(j - K));
    return out;
}

// As many scattered sources and modes as a PSF of +-16 native pixels has.
Case scattered_case(double eps) {
    char name[80];
    std::snprintf(name, sizeof name, "nonuniform FFT, 2500 nodes to 149^2 angles, eps %.0e", eps);
    return {name, "amplitude error / sum of sources", 0, eps, [eps] {
                constexpr size_t count = 2500;
                constexpr int64_t K = 74;
                constexpr double widest = 0.4; // radians a step: four samples a fringe and more
                std::mt19937 random(1);
                std::uniform_real_distribution<double> place(-widest, widest), any(-1, 1);
                std::vector<double> a(count), b(count);
                std::vector<Complex> c(count);
                for (size_t n = 0; n < count; ++n) {
                    a[n] = place(random);
                    b[n] = place(random);
                    c[n] = {any(random), any(random)};
                }
                Eigen::MatrixXcd product, amplitude(2 * K + 1, 2 * K + 1);
                Measured m;
                m.timing = time([&] {
                    Type1Transform transform({-widest, widest}, {-widest, widest}, K, eps);
                    transform.add(a, b, c);
                    transform.rows(-K, K, [&](int64_t jy, std::span<const Complex> modes) {
                        std::copy(modes.begin(), modes.end(), amplitude.col(jy + K).data());
                    });
                });
                m.baseline = "a matrix product";
                m.baseline_s =
                    time([&] {
                        const Eigen::Map<const Eigen::VectorXcd> sources(c.data(), count);
                        product = waves(a, K).transpose() * (sources.asDiagonal() * waves(b, K));
                    }).median_s;
                double sum = 0;
                for (const Complex &source : c)
                    sum += std::abs(source);
                m.error = (amplitude - product).cwiseAbs().maxCoeff() / sum;
                return m;
            }};
}

// A mask's square pixels, one row of it after the other.
Case mask_case(int64_t pixels, int64_t angles) {
    char name[80];
    std::snprintf(name, sizeof name, "chirp transform, %lld rows of %lld pixels to %lld angles",
                  static_cast<long long>(ChirpTransform::batch), static_cast<long long>(pixels),
                  static_cast<long long>(angles));
    return {
        name, "amplitude error / sum of sources", 0, 1e-13, [=] {
            constexpr int64_t batch = ChirpTransform::batch;
            const double turns = 0.25 / static_cast<double>(pixels);
            Eigen::MatrixXcd in(batch, pixels), product;
            std::mt19937 random(1);
            std::uniform_real_distribution<double> any(-1, 1);
            for (Eigen::Index n = 0; n < in.size(); ++n)
                in.data()[n] = {any(random), any(random)};
            const auto centred = [](int64_t i, int64_t size) {
                return static_cast<double>(i) - static_cast<double>(size - 1) / 2;
            };
            Measured m;
            m.baseline = "a matrix product";
            m.baseline_s = time([&] {
                               Eigen::MatrixXcd wave(pixels, angles);
                               for (int64_t j = 0; j < angles; ++j)
                                   for (int64_t n = 0; n < pixels; ++n)
                                       wave(n, j) = std::polar(1.0, 2 * oracle::pi * turns *
                                                                        centred(n, pixels) *
                                                                        centred(j, angles));
                               product = in * wave;
                           }).median_s;
            std::vector<Complex> buffer;
            m.timing = time([&] {
                const ChirpTransform chirp(pixels, angles, turns);
                buffer = chirp.buffer();
                std::copy_n(in.data(), in.size(), buffer.data());
                chirp.run(buffer);
            });
            const ChirpTransform chirp(pixels, angles, turns);
            for (int64_t j = 0; j < angles; ++j)
                for (int64_t s = 0; s < batch; ++s)
                    m.error = std::max(
                        m.error,
                        std::abs(std::abs(buffer[static_cast<size_t>(chirp.place(j) * batch + s)]) -
                                 std::abs(product(s, j))) /
                            in.row(s).cwiseAbs().sum());
            return m;
        }};
}

} // namespace

std::vector<Case> transform_cases() {
    return {scattered_case(1e-6), scattered_case(1e-10), mask_case(512, 512), mask_case(4096, 512)};
}

} // namespace wfpsf::bench
