// SPDX-License-Identifier: GPL-3.0-or-later
// Covariances after IPC, against the whole matrix K V K^T and against realisations.
#include "detector/ipc_covariance.hpp"
#include "detector/random.hpp"
#include "error/error.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace wfpsf {
namespace {

constexpr Edge edges[] = {Edge::zero, Edge::wrap};
constexpr IpcForm forms[] = {IpcForm::scatter, IpcForm::gather};

Plane<double> ramp(int64_t nx, int64_t ny, double low, double high, double pace) {
    Plane<double> image(nx, ny);
    for (int64_t y = 0; y < ny; ++y)
        for (int64_t x = 0; x < nx; ++x) {
            const double place = std::sin(pace * static_cast<double>(7 * x + 11 * y + 1));
            image(x, y) = low + (high - low) * (1 + place) / 2;
        }
    return image;
}

VaryingIpc of_maps(int64_t nx, int64_t ny) {
    return VaryingIpc::parametric(nx, ny,
                                  {ramp(nx, ny, 0.01, 0.04, 0.3), ramp(nx, ny, 0.001, 0.004, 0.7),
                                   ramp(nx, ny, -0.005, 0.005, 1.1)});
}

IpcKernel lopsided() {
    std::vector<double> table(15);
    for (size_t i = 0; i < table.size(); ++i)
        table[i] = 0.01 * (1 + std::sin(2 * static_cast<double>(i)));
    table[7] = 0.8;
    return IpcKernel::from_table({table.data(), 5, 3, 1, 5}, {.normalise = true});
}

VaryingIpc of_regions(int64_t nx, int64_t ny) {
    Image regions(PixelType::float32, nx, ny);
    const View<float> index = std::get<View<float>>(regions.pixels());
    for (int64_t y = 0; y < ny; ++y)
        for (int64_t x = 0; x < nx; ++x)
            index(x, y) = static_cast<float>((x / 2 + y) % 2);
    const std::vector<IpcKernel> kernels{IpcKernel::wfc3(), lopsided()};
    return VaryingIpc::of_regions(regions, kernels);
}

// K V K^T, entry by entry in long double; the columns of K are what becomes of unit charges.
class Dense {
  public:
    template <class Apply>
    Dense(View<const double> variance, const Apply &apply) : nx_(variance.nx), ny_(variance.ny) {
        for (int64_t j = 0; j < ny_; ++j)
            for (int64_t i = 0; i < nx_; ++i) {
                Plane<double> charge(nx_, ny_), column(nx_, ny_);
                charge(i, j) = 1;
                apply(std::as_const(charge).view(), column.view());
                columns_.push_back(column);
                variance_.push_back(variance(i, j));
            }
    }

    // 0 where p + lag is not a pixel
    double operator()(int64_t x, int64_t y, Lag lag, Edge edge) const {
        int64_t i = x + lag.x, j = y + lag.y;
        if (edge == Edge::wrap) {
            i = (i % nx_ + nx_) % nx_;
            j = (j % ny_ + ny_) % ny_;
        } else if (i < 0 || i >= nx_ || j < 0 || j >= ny_) {
            return 0;
        }
        long double sum = 0;
        for (size_t q = 0; q < columns_.size(); ++q)
            sum += static_cast<long double>(columns_[q](x, y)) * columns_[q](i, j) * variance_[q];
        return static_cast<double>(sum);
    }

  private:
    int64_t nx_, ny_;
    std::vector<Plane<double>> columns_;
    std::vector<double> variance_;
};

constexpr int64_t sizes[][2] = {{1, 1}, {1, 7}, {6, 1}, {2, 2}, {4, 3}, {9, 8}};

TEST(IpcCovariance, IsKVKt) {
    for (const auto &[nx, ny] : sizes)
        for (const Edge edge : edges)
            for (const IpcForm form : forms)
                for (const VaryingIpc &ipc : {of_maps(nx, ny), of_regions(nx, ny)}) {
                    const VaryingConvolution how{form, edge};
                    const Plane<double> variance = ramp(nx, ny, 0.5, 20, 0.9);
                    const Dense dense(variance.view(),
                                      [&](auto from, auto to) { convolve(ipc, from, how, to); });
                    const int64_t rx = 2 * ipc.reach_x(), ry = 2 * ipc.reach_y();
                    Image given(PixelType::float64, nx, ny);
                    std::copy_n(variance.view().data, nx * ny,
                                std::get<View<double>>(given.pixels()).data);
                    std::vector<Plane<double>> at; // every pixel's autocorrelation
                    for (int64_t y = 0; y < ny; ++y)
                        for (int64_t x = 0; x < nx; ++x)
                            at.push_back(neighbour_covariances(ipc, &given, x, y, how));
                    for (int64_t ly = -ry - 1; ly <= ry + 1; ++ly)
                        for (int64_t lx = -rx - 1; lx <= rx + 1; ++lx) {
                            Plane<double> out(nx, ny);
                            covariance(ipc, variance.view(), {lx, ly}, how, out.view());
                            for (int64_t y = 0; y < ny; ++y)
                                for (int64_t x = 0; x < nx; ++x) {
                                    const double wanted = dense(x, y, {lx, ly}, edge);
                                    ASSERT_NEAR(out(x, y), wanted, 20e-15)
                                        << nx << " x " << ny << ", lag " << lx << ", " << ly
                                        << ", edge " << static_cast<int>(edge) << ", form "
                                        << static_cast<int>(form);
                                    if (std::abs(lx) > rx || std::abs(ly) > ry)
                                        continue;
                                    const Plane<double> &table =
                                        at[static_cast<size_t>(y * nx + x)];
                                    ASSERT_NEAR(table(lx + rx, ly + ry), wanted, 20e-15);
                                }
                        }
                }
}

TEST(IpcCovariance, OfOneKernelIsKVKt) {
    const IpcKernel kernel = lopsided();
    for (const auto &[nx, ny] : sizes)
        for (const Edge edge : edges)
            for (const int64_t step : {1, 2, 3}) {
                const Convolution how{.edge = edge, .tap_step = step};
                const Plane<double> variance = ramp(nx, ny, 0.5, 20, 0.9);
                const Dense dense(variance.view(),
                                  [&](auto from, auto to) { convolve(kernel, from, how, to); });
                for (int64_t ly = -3; ly <= 3; ++ly)
                    for (int64_t lx = -5; lx <= 5; ++lx) {
                        Plane<double> out = variance;
                        covariance(kernel, std::as_const(out).view(), {lx, ly}, how, out.view());
                        for (int64_t y = 0; y < ny; ++y)
                            for (int64_t x = 0; x < nx; ++x)
                                ASSERT_NEAR(out(x, y), dense(x, y, {lx * step, ly * step}, edge),
                                            20e-15)
                                    << nx << " x " << ny << ", lag " << lx << ", " << ly
                                    << ", edge " << static_cast<int>(edge) << ", step " << step;
                    }
            }
}

TEST(IpcCovariance, ReducesToTheInvariantKernel) {
    constexpr int64_t nx = 41, ny = 30;
    const std::vector<IpcKernel> one{lopsided()};
    const VaryingIpc ipc = VaryingIpc::of_regions(Image(PixelType::float32, nx, ny), one);
    const Plane<double> variance = ramp(nx, ny, 0.5, 20, 0.9);
    for (const Edge edge : edges)
        for (const IpcForm form : forms) {
            const IpcKernel kernel = form == IpcForm::scatter ? one[0] : one[0].flipped();
            for (const Lag lag : {Lag{0, 0}, Lag{1, 0}, Lag{-3, 2}}) {
                Plane<double> out(nx, ny), wanted(nx, ny);
                covariance(ipc, variance.view(), lag, {form, edge, 0, 3}, out.view());
                covariance(kernel, variance.view(), lag, {edge}, wanted.view());
                for (int64_t y = 0; y < ny; ++y)
                    for (int64_t x = 0; x < nx; ++x)
                        ASSERT_NEAR(out(x, y), wanted(x, y), 20e-15);
            }
            const Plane<double> white = neighbour_covariances(ipc, nullptr, 20, 15, {form, edge});
            const IpcKernel wanted = one[0].autocorrelation();
            for (int64_t y = -2; y <= 2; ++y)
                for (int64_t x = -4; x <= 4; ++x)
                    ASSERT_NEAR(white(x + 4, y + 2), wanted(x, y), 4e-16);
        }
}

// The mean over many draws of the product of two pixels, each pixel of the map within five of its
// own standard errors, and those errors of the size that they should have.
TEST(IpcCovariance, IsThatOfRealisations) {
    constexpr int64_t n = 12;
    constexpr int draws = 20000;
    const VaryingIpc ipc = of_maps(n, n);
    const Plane<double> variance = ramp(n, n, 0.5, 20, 0.9);
    for (const IpcForm form : forms) {
        const VaryingConvolution how{form, Edge::wrap};
        const Lag lags[] = {{0, 0}, {1, 0}, {-1, 1}, {0, 2}};
        std::vector<Plane<double>> sums(std::size(lags), Plane<double>(n, n)), closed = sums;
        Plane<double> white(n, n), seen(n, n), spread(n, n);
        for (uint32_t draw = 0; draw < draws; ++draw) {
            for (int64_t y = 0; y < n; ++y) {
                fill_normal({.seed = 5, .stream = draw}, 0, y, n, white.view().row(y));
                for (int64_t x = 0; x < n; ++x)
                    white(x, y) *= std::sqrt(variance(x, y));
            }
            convolve(ipc, std::as_const(white).view(), how, seen.view());
            for (size_t k = 0; k < std::size(lags); ++k)
                for (int64_t y = 0; y < n; ++y)
                    for (int64_t x = 0; x < n; ++x)
                        sums[k](x, y) +=
                            seen(x, y) * seen((x + lags[k].x + n) % n, (y + lags[k].y + n) % n);
        }
        covariance(ipc, variance.view(), {0, 0}, how, spread.view());
        for (size_t k = 0; k < std::size(lags); ++k) {
            covariance(ipc, variance.view(), lags[k], how, closed[k].view());
            double squares = 0;
            for (int64_t y = 0; y < n; ++y)
                for (int64_t x = 0; x < n; ++x) {
                    const double c = closed[k](x, y);
                    const double both =
                        spread(x, y) * spread((x + lags[k].x + n) % n, (y + lags[k].y + n) % n);
                    const double error = std::sqrt((both + c * c) / draws);
                    const double off = (sums[k](x, y) / draws - c) / error;
                    EXPECT_LT(std::fabs(off), 5);
                    squares += off * off;
                }
            EXPECT_NEAR(squares / (n * n), 1, 0.6);
        }
    }
}

TEST(IpcCovariance, HardCases) {
    const VaryingIpc ipc = of_maps(6, 5);
    Plane<float> variance(6, 5), out(6, 5);
    for (int64_t y = 0; y < 5; ++y)
        for (int64_t x = 0; x < 6; ++x)
            variance(x, y) = 1e30F;
    variance(0, 0) = std::numeric_limits<float>::quiet_NaN();
    covariance(ipc, std::as_const(variance).view(), {0, 0}, {}, out.view());
    for (int64_t y = 0; y < 5; ++y)
        for (int64_t x = 0; x < 6; ++x)
            EXPECT_EQ(std::isfinite(out(x, y)), x > 1 || y > 1);
    constexpr int64_t most = std::numeric_limits<int64_t>::max();
    for (const Lag lag : {Lag{most, 0}, Lag{-most - 1, -most - 1}, Lag{0, 6}})
        for (const IpcForm form : forms) {
            covariance(ipc, std::as_const(variance).view(), lag, {form}, out.view());
            for (int64_t y = 0; y < 5; ++y)
                for (int64_t x = 0; x < 6; ++x)
                    EXPECT_EQ(out(x, y), 0);
        }
    Plane<double> none(0, 5);
    covariance(of_maps(0, 5), std::as_const(none).view(), {1, 0}, {.edge = Edge::wrap},
               none.view());
    covariance(lopsided(), std::as_const(none).view(), {1, 0}, {Edge::wrap}, none.view());
    EXPECT_THROW(
        covariance(ipc, std::as_const(variance).view(), {0, 0}, {.edge = Edge::crop}, out.view()),
        Error);
    EXPECT_THROW(neighbour_covariances(ipc, nullptr, 0, 0, {.edge = Edge::replicate}), Error);
    EXPECT_THROW(neighbour_covariances(ipc, nullptr, 6, 0, {}), Error);
    const Image small(PixelType::float32, 5, 5);
    EXPECT_THROW(neighbour_covariances(ipc, &small, 0, 0, {}), Error);
}

} // namespace
} // namespace wfpsf
