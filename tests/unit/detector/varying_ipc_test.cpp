// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/varying_ipc.hpp"
#include "error/error.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace wfpsf {
namespace {

const Edge all_edges[] = {Edge::zero, Edge::replicate, Edge::wrap,
                          Edge::crop, Edge::fill,      Edge::valid};
const Edge invertible_edges[] = {Edge::zero, Edge::replicate, Edge::wrap};
const IpcForm forms[] = {IpcForm::scatter, IpcForm::gather};
constexpr double fill_value = -3.5;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

template <class T = double>
Plane<T> noise(int64_t nx, int64_t ny, double low = 0, double high = 1, uint32_t state = 12345) {
    Plane<T> image(nx, ny);
    for (int64_t y = 0; y < ny; ++y)
        for (int64_t x = 0; x < nx; ++x) {
            state = state * 1664525U + 1013904223U;
            image(x, y) =
                static_cast<T>(low + (high - low) * static_cast<double>(state >> 16) / 65536.0);
        }
    return image;
}

VaryingIpc of_maps(int64_t nx, int64_t ny, double largest = 0.03) {
    return VaryingIpc::parametric(nx, ny,
                                  {noise(nx, ny, largest / 3, largest, 1),
                                   noise<float>(nx, ny, 0, largest / 10, 2),
                                   noise(nx, ny, -largest / 4, largest / 4, 3)});
}

VaryingIpc of_polynomials(int64_t nx, int64_t ny) {
    const std::vector<double> alpha{0.02, 0.004, -0.003, 0.001, 0.0005, -0.002},
        alpha_prime{0.002, 0.0005, 0.0003}, alpha_plus{0.001};
    return VaryingIpc::parametric(nx, ny,
                                  {SurfacePolynomial(2, alpha), SurfacePolynomial(1, alpha_prime),
                                   SurfacePolynomial(0, alpha_plus)});
}

// Three kernels of different sizes, without symmetry.
std::vector<IpcKernel> kernels() {
    const double row[5] = {0.01, 0.02, 0.9, 0.04, 0.03};
    std::vector<double> table(15);
    for (size_t i = 0; i < table.size(); ++i)
        table[i] = 0.004 * (1 + std::sin(3.0 + 2.0 * static_cast<double>(i)));
    table[7] = 0.8;
    return {IpcKernel::wfc3(), IpcKernel::from_table({row, 5, 1, 1, 5}),
            IpcKernel::from_table({table.data(), 3, 5, 1, 3}, {.normalise = true})};
}

VaryingIpc of_regions(int64_t nx, int64_t ny) {
    Image regions(PixelType::float32, nx, ny);
    const View<float> index = std::get<View<float>>(regions.pixels());
    for (int64_t y = 0; y < ny; ++y)
        for (int64_t x = 0; x < nx; ++x)
            index(x, y) = static_cast<float>((x / 3 + 2 * y) % 3);
    return VaryingIpc::of_regions(regions, kernels());
}

std::vector<VaryingIpc> all_kinds(int64_t nx, int64_t ny) {
    return {of_maps(nx, ny), of_polynomials(nx, ny), of_regions(nx, ny)};
}

int64_t beyond(int64_t i, int64_t n, Edge edge) {
    if (edge == Edge::wrap)
        return ((i % n) + n) % n;
    if (edge == Edge::replicate)
        return std::clamp<int64_t>(i, 0, n - 1);
    return i < 0 || i >= n ? -1 : i;
}

// By the definition, one pixel's kernel at a time.
template <class T>
long double brute_force(const VaryingIpc &ipc, View<const T> in, IpcForm form, Edge edge, int64_t x,
                        int64_t y) {
    const int64_t rx = ipc.reach_x(), ry = ipc.reach_y();
    const bool border = x < rx || x >= in.nx - rx || y < ry || y >= in.ny - ry;
    if (border && edge == Edge::crop)
        return in(x, y);
    if (border && edge == Edge::fill)
        return fill_value;
    long double sum = 0;
    for (int64_t dy = -ry; dy <= ry; ++dy)
        for (int64_t dx = -rx; dx <= rx; ++dx) {
            const int sign = form == IpcForm::scatter ? -1 : 1;
            const int64_t i = beyond(x + sign * dx, in.nx, edge);
            const int64_t j = beyond(y + sign * dy, in.ny, edge);
            if (i < 0 || j < 0)
                continue;
            const IpcKernel kernel = form == IpcForm::scatter ? ipc.kernel(i, j) : ipc.kernel(x, y);
            sum += static_cast<long double>(kernel.tap_or_zero(dx, dy)) * in(i, j);
        }
    return sum;
}

template <class T> void compare_with_brute_force(double tolerance) {
    const int64_t sizes[][2] = {{1, 1}, {1, 7}, {7, 1}, {2, 2}, {4, 3}, {11, 9}, {0, 3}};
    for (const auto &[nx, ny] : sizes)
        for (const VaryingIpc &ipc : all_kinds(nx, ny)) {
            const Plane<T> in = noise<T>(nx, ny, -1, 1);
            Plane<T> flipped = in; // the same pixels seen from the last one, every other column
            Plane<T> spaced(2 * nx + 1, ny);
            const View<T> sparse{spaced.view().data, nx, ny, 2, 2 * nx + 1};
            for (int64_t y = 0; y < ny; ++y)
                for (int64_t x = 0; x < nx; ++x)
                    flipped(nx - 1 - x, ny - 1 - y) = in(x, y);
            const View<const T> backwards{flipped.view().data + std::max<int64_t>(nx * ny - 1, 0),
                                          nx, ny, -1, -nx};
            for (const Edge edge : all_edges)
                for (const IpcForm form : forms) {
                    const int64_t x0 = edge == Edge::valid ? ipc.reach_x() : 0;
                    const int64_t y0 = edge == Edge::valid ? ipc.reach_y() : 0;
                    const int64_t out_nx = std::max<int64_t>(nx - 2 * x0, 0),
                                  out_ny = std::max<int64_t>(ny - 2 * y0, 0);
                    const VaryingConvolution how{form, edge, fill_value, 1};
                    Plane<T> out(out_nx, out_ny);
                    convolve(ipc, in.view(), how, out.view());
                    for (int64_t y = 0; y < out_ny; ++y)
                        for (int64_t x = 0; x < out_nx; ++x)
                            ASSERT_NEAR(static_cast<double>(out(x, y)),
                                        static_cast<double>(brute_force<T>(ipc, in.view(), form,
                                                                           edge, x + x0, y + y0)),
                                        tolerance)
                                << nx << " x " << ny << ", edge " << static_cast<int>(edge)
                                << ", form " << static_cast<int>(form);
                    if (edge == Edge::valid)
                        continue;
                    // strided, flipped, in place and on threads: the same bits
                    convolve(ipc, backwards, {form, edge, fill_value, 3}, sparse);
                    Plane<T> same = in;
                    convolve(ipc, std::as_const(same).view(), {form, edge, fill_value, 4},
                             same.view());
                    for (int64_t y = 0; y < ny; ++y)
                        for (int64_t x = 0; x < nx; ++x) {
                            ASSERT_EQ(sparse(x, y), out(x, y));
                            ASSERT_EQ(same(x, y), out(x, y));
                        }
                }
        }
}

TEST(VaryingIpc, AgreesWithBruteForceInDouble) {
    compare_with_brute_force<double>(1e-15);
}

TEST(VaryingIpc, AgreesWithBruteForceInFloat) {
    compare_with_brute_force<float>(1e-7);
}

TEST(VaryingIpc, ReducesToTheInvariantKernel) {
    constexpr int64_t nx = 41, ny = 30;
    const IpcKernel kernel = IpcKernel::parametric(0.02, 0.002, 0.001);
    const auto constant = [](double value) {
        Plane<double> map(nx, ny);
        std::fill_n(map.view().data, nx * ny, value);
        return map;
    };
    const auto polynomial = [](double value) { return SurfacePolynomial(0, std::array{value}); };
    const std::vector<IpcKernel> one{kernel};
    const VaryingIpc kinds[] = {
        VaryingIpc::parametric(nx, ny, {constant(0.02), constant(0.002), constant(0.001)}),
        VaryingIpc::parametric(nx, ny, {polynomial(0.02), polynomial(0.002), polynomial(0.001)}),
        VaryingIpc::of_regions(Image(PixelType::float32, nx, ny), one)};
    const Plane<double> in = noise(nx, ny);
    for (const VaryingIpc &ipc : kinds)
        for (const Edge edge : invertible_edges)
            for (const IpcForm form : forms) {
                Plane<double> out(nx, ny), wanted(nx, ny);
                convolve(ipc, in.view(), {form, edge}, out.view());
                convolve(form == IpcForm::scatter ? kernel : kernel.flipped(), in.view(), {edge},
                         wanted.view());
                for (int64_t y = 0; y < ny; ++y)
                    for (int64_t x = 0; x < nx; ++x)
                        ASSERT_NEAR(out(x, y), wanted(x, y), 3e-16);
                EXPECT_NEAR(ipc.weakest().margin, kernel.margin().value, 1e-12);
            }
}

TEST(VaryingIpc, PolynomialsAreInTheDetectorsCoordinates) {
    const std::vector<double> alpha{0.05, 0.01, 0.02, 0.003, 0.004, 0.005};
    const VaryingIpc ipc = VaryingIpc::parametric(4, 5, {SurfacePolynomial(2, alpha), {}, {}});
    const double X = 0.25, Y = -0.8; // pixel (2, 0): centres at -3/4, -1/4, ... and -4/5, -2/5, ...
    EXPECT_NEAR(ipc.kernel(2, 0)(1, 0),
                0.05 + 0.01 * X + 0.02 * Y + 0.003 * X * X + 0.004 * X * Y + 0.005 * Y * Y, 1e-17);
}

TEST(VaryingIpc, ScatterConservesCharge) {
    for (const VaryingIpc &ipc : all_kinds(101, 67)) {
        const Plane<double> in = noise(101, 67);
        Plane<double> scattered(101, 67), gathered(101, 67);
        convolve(ipc, in.view(), {IpcForm::scatter, Edge::wrap}, scattered.view());
        convolve(ipc, in.view(), {IpcForm::gather, Edge::wrap}, gathered.view());
        long double before = 0, after = 0, other = 0;
        for (int64_t y = 0; y < 67; ++y)
            for (int64_t x = 0; x < 101; ++x)
                before += in(x, y), after += scattered(x, y), other += gathered(x, y);
        EXPECT_NEAR(static_cast<double>(after / before), 1, 1e-15);
        EXPECT_GT(std::fabs(static_cast<double>(other / before - 1)), 1e-7);
    }
}

TEST(VaryingIpc, GatherIsTheTransposeOfScatter) {
    for (const VaryingIpc &ipc : all_kinds(23, 17))
        for (const Edge edge : {Edge::zero, Edge::wrap}) {
            const Plane<double> u = noise(23, 17), v = noise(23, 17, -1, 1, 7);
            Plane<double> Au(23, 17), Bv(23, 17);
            convolve(ipc, u.view(), {IpcForm::scatter, edge}, Au.view());
            convolve(ipc, v.view(), {IpcForm::gather, edge}, Bv.view());
            long double left = 0, right = 0;
            for (int64_t y = 0; y < 17; ++y)
                for (int64_t x = 0; x < 23; ++x)
                    left += v(x, y) * Au(x, y), right += Bv(x, y) * u(x, y);
            EXPECT_NEAR(static_cast<double>(left), static_cast<double>(right), 1e-13);
        }
}

TEST(VaryingIpc, HardPixelsStayLocal) {
    const VaryingIpc ipc = of_maps(9, 9);
    Plane<float> in(9, 9), out(9, 9);
    for (int64_t y = 0; y < 9; ++y)
        for (int64_t x = 0; x < 9; ++x)
            in(x, y) = -1e30F;
    in(4, 4) = std::numeric_limits<float>::quiet_NaN();
    in(0, 8) = std::numeric_limits<float>::infinity();
    for (const IpcForm form : forms) {
        convolve(ipc, in.view(), {form, Edge::replicate}, out.view());
        for (int64_t y = 0; y < 9; ++y)
            for (int64_t x = 0; x < 9; ++x) {
                const bool near_nan = std::abs(x - 4) <= 1 && std::abs(y - 4) <= 1;
                EXPECT_EQ(std::isnan(out(x, y)), near_nan);
                if (!near_nan && !(x <= 1 && y >= 7)) {
                    EXPECT_NEAR(out(x, y), -1e30F, 2e29F);
                }
            }
    }
}

double largest_difference(const Plane<double> &a, const Plane<double> &b) {
    double most = 0;
    for (int64_t y = 0; y < a.ny(); ++y)
        for (int64_t x = 0; x < a.nx(); ++x)
            most = std::max(most, std::fabs(a(x, y) - b(x, y)));
    return most;
}

TEST(VaryingIpcSolve, UndoesWhatWasApplied) {
    for (const auto &[nx, ny] :
         {std::pair(1, 1), std::pair(1, 9), std::pair(2, 2), std::pair(41, 30)}) {
        std::vector<VaryingIpc> kinds = all_kinds(nx, ny);
        kinds.push_back(of_maps(nx, ny, 0.095)); // 1 - 8 alpha near 0.2
        for (const VaryingIpc &ipc : kinds)
            for (const IpcForm form : forms)
                for (const Edge edge : invertible_edges) {
                    const Plane<double> charge = noise(nx, ny);
                    Plane<double> seen(nx, ny);
                    convolve(ipc, charge.view(), {form, edge}, seen.view());
                    const Solution solution = solve_ipc(ipc, std::as_const(seen).view(),
                                                        {form, edge, 0, 2}, {}, true, seen.view());
                    const double error = largest_difference(seen, charge);
                    EXPECT_TRUE(solution.converged);
                    EXPECT_LE(error, 1e-13);
                    EXPECT_LE(error, 20 * std::max(solution.residual, 2e-16) / solution.margin);
                    EXPECT_GT(solution.passes, 0);
                }
    }
}

// Near 1/8 alpha varies by a share of the margin: the passes go as 1 / sqrt(margin).
TEST(VaryingIpcSolve, ErrorGrowsAsOneOverTheMargin) {
    constexpr int64_t n = 32;
    const Plane<double> charge = noise(n, n);
    for (const double margin : {1e-1, 1e-2, 1e-3})
        for (const Edge edge : invertible_edges) {
            const VaryingIpc ipc = VaryingIpc::parametric(
                n, n, {noise(n, n, (1 - 3 * margin) / 8, (1 - margin) / 8), {}, {}});
            Plane<double> seen(n, n), found(n, n);
            convolve(ipc, charge.view(), {.edge = edge}, seen.view());
            const Solution solution = solve_ipc(ipc, std::as_const(seen).view(), {.edge = edge},
                                                {.most_passes = 10000}, false, found.view());
            EXPECT_TRUE(solution.converged);
            EXPECT_LE(largest_difference(found, charge), 4e-15 / margin);
        }
}

TEST(VaryingIpcSolve, MeasuresTheAmplificationOfNoise) {
    constexpr int64_t n = 256;
    const IpcKernel kernel = IpcKernel::parametric(0.06, 0.003);
    const std::vector<IpcKernel> one{kernel};
    Plane<double> out(n, n);
    const Plane<double> in = noise(n, n);
    const Solution solution =
        solve_ipc(VaryingIpc::of_regions(Image(PixelType::float32, n, n), one), in.view(),
                  {.edge = Edge::wrap}, {}, true, out.view());
    const double wanted = inverse_noise_amplification(kernel);
    EXPECT_NEAR(solution.noise_amplification / wanted, 1, 4.0 / n); // 4 standard errors at most
    // A single pixel: exact.
    Plane<double> pixel(1, 1);
    const VaryingIpc alone =
        VaryingIpc::parametric(1, 1, {SurfacePolynomial(0, std::array{0.05}), {}, {}});
    EXPECT_NEAR(solve_ipc(alone, std::as_const(pixel).view(), {}, {}, true, pixel.view())
                    .noise_amplification,
                1 / 0.8, 1e-3);
}

TEST(VaryingIpcSolve, PixelsThatAreNotFiniteStayAndAreCounted) {
    const VaryingIpc ipc = of_maps(9, 9);
    Plane<float> in = noise<float>(9, 9, -1e30, 0), out(9, 9), clean(9, 9);
    in(4, 4) = 0;
    solve_ipc(ipc, std::as_const(in).view(), {}, {}, false, clean.view());
    in(4, 4) = std::numeric_limits<float>::quiet_NaN();
    const Solution solution = solve_ipc(ipc, std::as_const(in).view(), {}, {}, false, out.view());
    EXPECT_EQ(solution.not_finite, 1);
    for (int64_t y = 0; y < 9; ++y)
        for (int64_t x = 0; x < 9; ++x)
            if (x == 4 && y == 4)
                EXPECT_TRUE(std::isnan(out(x, y)));
            else
                EXPECT_EQ(out(x, y), clean(x, y));
}

template <class Call> void expect_failure(wfpsf_status status, const char *culprit, Call call) {
    try {
        call();
        ADD_FAILURE() << culprit;
    } catch (const Error &error) {
        EXPECT_EQ(error.status(), status) << error.what();
        EXPECT_NE(std::string(error.what()).find(culprit), std::string::npos) << error.what();
    }
}

TEST(VaryingIpc, RefusesBadArguments) {
    const auto with_alpha = [](Plane<double> alpha, bool allow_negative = false) {
        return VaryingIpc::parametric(3, 3, {std::move(alpha), {}, {}}, allow_negative);
    };
    Plane<double> alpha(3, 3);
    alpha(1, 2) = nan;
    expect_failure(WFPSF_ERROR_NOT_FINITE, "alpha(1, 2) = nan", [&] { with_alpha(alpha); });
    alpha(1, 2) = -0.01;
    expect_failure(WFPSF_ERROR_KERNEL, "pixel (1, 2)", [&] { with_alpha(alpha); });
    EXPECT_NEAR(with_alpha(alpha, true).kernel(1, 2)(0, 1), -0.01, 1e-17);
    expect_failure(WFPSF_ERROR_SIZE, "2 x 3", [&] { with_alpha(Plane<double>(2, 3)); });
    expect_failure(WFPSF_ERROR_RANGE, "degree = 21",
                   [] { SurfacePolynomial(21, std::vector<double>(253)); });
    expect_failure(WFPSF_ERROR_SIZE, "3 coefficients",
                   [] { SurfacePolynomial(1, std::vector<double>(2)); });
    Image regions(PixelType::float64, 3, 3);
    for (const double bad : {-1.0, 3.0, 0.5, nan}) {
        std::get<View<double>>(regions.pixels())(2, 1) = bad;
        expect_failure(WFPSF_ERROR_RANGE, "regions(2, 1)",
                       [&] { VaryingIpc::of_regions(regions, kernels()); });
    }
    alpha(1, 2) = 0.1249;
    const VaryingIpc ipc = with_alpha(alpha);
    EXPECT_NEAR(ipc.weakest().margin, 1 - 8 * 0.1249, 1e-15);
    EXPECT_TRUE(ipc.weakest().x == 1 && ipc.weakest().y == 2);
    Plane<double> out(3, 3), small(2, 3);
    expect_failure(WFPSF_ERROR_KERNEL_SINGULAR, "pixel (1, 2)",
                   [&] { solve_ipc(ipc, std::as_const(alpha).view(), {}, {}, true, out.view()); });
    solve_ipc(ipc, std::as_const(alpha).view(), {}, {.least_margin = 1e-5}, false, out.view());
    expect_failure(WFPSF_ERROR_SIZE, "the detector has 3 x 3",
                   [&] { convolve(ipc, std::as_const(small).view(), {}, small.view()); });
    expect_failure(WFPSF_ERROR_ARGUMENT, "edge = 3", [&] {
        solve_ipc(ipc, std::as_const(alpha).view(), {.edge = Edge::crop}, {}, false, out.view());
    });
    expect_failure(WFPSF_ERROR_RANGE, "pixel (3, 0)", [&] { ipc.kernel(3, 0); });
}

} // namespace
} // namespace wfpsf
