// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/ipc_kernel.hpp"
#include "error/error.hpp"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <string>

namespace wfpsf {
namespace {

void expect_error(wfpsf_status status, const std::string &part, const std::function<void()> &call) {
    try {
        call();
        ADD_FAILURE() << "no error; expected: " << part;
    } catch (const Error &error) {
        EXPECT_EQ(error.status(), status) << error.what();
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

IpcKernel table_3x3(const double (&taps)[9], KernelOptions options = {}) {
    return IpcKernel::from_table({taps, 3, 3, 1, 3}, options);
}

TEST(IpcKernel, ParametersStandWhereThePaperHasThem) {
    const IpcKernel k = IpcKernel::parametric(0.02, 0.002, 0.005);
    EXPECT_EQ(k.nx(), 3);
    EXPECT_EQ(k.ny(), 3);
    for (int64_t sign : {-1, 1}) {
        EXPECT_DOUBLE_EQ(k(sign, 0), 0.025);
        EXPECT_DOUBLE_EQ(k(0, sign), 0.015);
        EXPECT_EQ(k(sign, 1), 0.002);
        EXPECT_EQ(k(sign, -1), 0.002);
    }
    EXPECT_DOUBLE_EQ(k(0, 0), 1 - 4 * 0.022);
    EXPECT_DOUBLE_EQ(k.sum(), 1);
    EXPECT_EQ(IpcKernel::parametric(0.02)(1, 1), 0);
    EXPECT_EQ(IpcKernel::parametric(0)(0, 0), 1);
}

TEST(IpcKernel, MomentsOfTheParametricKernelAreClosedForms) {
    const double a = 0.02, q = 0.002, p = 0.005;
    const KernelMoments m = IpcKernel::parametric(a, q, p).moments();
    EXPECT_NEAR(m.x, 0, 1e-17);
    EXPECT_NEAR(m.y, 0, 1e-17);
    EXPECT_NEAR(m.xx, 2 * (a + p) + 4 * q, 1e-16);
    EXPECT_NEAR(m.yy, 2 * (a - p) + 4 * q, 1e-16);
    EXPECT_NEAR(m.xy, 0, 1e-17);
    const KernelMoments corrected =
        IpcKernel::parametric(a, q, p).first_order_correction().moments();
    EXPECT_NEAR(corrected.xx, -m.xx, 1e-16);
}

TEST(IpcKernel, MomentsAreAboutTheCentroid) {
    const double taps[3] = {0, 0.75, 0.25};
    const KernelMoments row = IpcKernel::from_table({taps, 3, 1, 1, 3}).moments();
    EXPECT_DOUBLE_EQ(row.x, 0.25);
    EXPECT_DOUBLE_EQ(row.xx, 0.25 * 0.75);
    EXPECT_EQ(row.yy, 0);
    const double diagonal[9] = {0.5, 0, 0, 0, 0, 0, 0, 0, 0.5};
    EXPECT_DOUBLE_EQ(table_3x3(diagonal).moments().xy, 1);
}

TEST(IpcKernel, TableIsReadThroughItsStrides) {
    const double taps[15] = {0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.44,
                             0.08, 0.09, 0.03, 0.02, 0.01, 0.02, 0.03};
    const IpcKernel k = IpcKernel::from_table({taps, 5, 3, 1, 5});
    EXPECT_EQ(k.reach_x(), 2);
    EXPECT_EQ(k.reach_y(), 1);
    EXPECT_EQ(k(-2, -1), 0.01); // the first row is the lowest
    EXPECT_EQ(k(2, -1), 0.05);
    EXPECT_EQ(k(0, 0), 0.44);
    EXPECT_EQ(k(-2, 1), 0.03);

    const IpcKernel turned = IpcKernel::from_table({taps + 14, 5, 3, -1, -5});
    const IpcKernel transposed = IpcKernel::from_table({taps, 3, 5, 5, 1});
    for (int64_t dy = -1; dy <= 1; ++dy) {
        for (int64_t dx = -2; dx <= 2; ++dx) {
            EXPECT_EQ(turned(dx, dy), k(-dx, -dy));
            EXPECT_EQ(k.flipped()(dx, dy), k(-dx, -dy));
            EXPECT_EQ(transposed(dy, dx), k(dx, dy));
        }
    }
}

TEST(IpcKernel, Wfc3IsAsPrintedDividedByItsSum) {
    const IpcKernel k = IpcKernel::wfc3();
    const double printed_sum = 0.9985;
    EXPECT_DOUBLE_EQ(k(-1, 0), 0.0163 / printed_sum);
    EXPECT_DOUBLE_EQ(k(1, 0), 0.0164 / printed_sum);
    EXPECT_DOUBLE_EQ(k(0, 1), 0.0127 / printed_sum);
    EXPECT_DOUBLE_EQ(k(0, -1), 0.0127 / printed_sum);
    EXPECT_DOUBLE_EQ(k(1, -1), 0.0011 / printed_sum);
    EXPECT_DOUBLE_EQ(k(0, 0), 0.936 / printed_sum);
    EXPECT_DOUBLE_EQ(k.sum(), 1);
}

TEST(IpcKernel, CorrectionReversesTheSignsOfTheParameters) {
    const IpcKernel k = IpcKernel::parametric(0.02, 0.002, 0.003).first_order_correction();
    const IpcKernel reversed =
        IpcKernel::parametric(-0.02, -0.002, -0.003, {.allow_negative = true});
    for (int64_t dy = -1; dy <= 1; ++dy)
        for (int64_t dx = -1; dx <= 1; ++dx)
            EXPECT_NEAR(k(dx, dy), reversed(dx, dy), 3e-16);
    EXPECT_DOUBLE_EQ(k.sum(), 1);
}

TEST(IpcKernel, RefusesWhatIsNoKernel) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    expect_error(WFPSF_ERROR_NOT_FINITE, "alpha_prime = nan",
                 [&] { IpcKernel::parametric(0.02, nan); });
    expect_error(WFPSF_ERROR_KERNEL, "(0, -1) is -0.0",
                 [] { IpcKernel::parametric(0.02, 0, 0.03); });
    expect_error(WFPSF_ERROR_KERNEL, "(0, 0) is -", [] { IpcKernel::parametric(0.3); });

    const double taps[9] = {0, 0.1, 0, 0.1, 0.5, 0.1, 0, 0.1, 0};
    expect_error(WFPSF_ERROR_KERNEL, "sum of the kernel's taps = 0.89999",
                 [&] { table_3x3(taps); });
    EXPECT_DOUBLE_EQ(table_3x3(taps, {.normalise = true})(0, 0), 0.5 / 0.9);

    const double with_nan[9] = {0, 0, 0, 0, 1, 0, nan, 0, 0};
    expect_error(WFPSF_ERROR_NOT_FINITE, "(-1, 1)", [&] { table_3x3(with_nan); });
    const double negative[9] = {0, 0, 0, 0, 1.1, -0.1, 0, 0, 0};
    expect_error(WFPSF_ERROR_KERNEL, "(0, 0) is 1.1", [&] { table_3x3(negative); });
    EXPECT_EQ(table_3x3(negative, {.allow_negative = true})(1, 0), -0.1);

    const double cancelling[3] = {-1, 0, 1};
    for (bool normalise : {false, true})
        expect_error(WFPSF_ERROR_KERNEL, "sum of the kernel's taps = 0", [&] {
            IpcKernel::from_table({cancelling, 3, 1, 1, 3}, {true, normalise});
        });
    const double nearly_cancelling[3] = {-1, 1e-17, 1};
    expect_error(WFPSF_ERROR_KERNEL, "sum of the kernel's taps", [&] {
        IpcKernel::from_table({nearly_cancelling, 3, 1, 1, 3}, {true, true});
    });
    const double huge[3] = {1e308, 1e308, 1e308};
    expect_error(WFPSF_ERROR_KERNEL, "= inf", [&] {
        IpcKernel::from_table({huge, 3, 1, 1, 3}, {.normalise = true});
    });

    struct {
        int64_t nx, ny;
    } const bad_sizes[] = {{0, 0}, {2, 3}, {3, 2}, {-1, 3}, {3, 0}, {1025, 1}};
    for (auto size : bad_sizes)
        expect_error(WFPSF_ERROR_SIZE, "sizes must be odd, 1..1023", [&] {
            IpcKernel::from_table({taps, size.nx, size.ny, 0, 0});
        });
}

TEST(IpcKernel, MarginsOfTheParametricKernelsAreClosedForms) {
    const auto expect_margin = [](const IpcKernel &kernel, double value, double fx, double fy) {
        const StabilityMargin margin = kernel.margin();
        EXPECT_NEAR(margin.value, value, 1e-15);
        EXPECT_NEAR(std::fabs(margin.frequency_x), fx, 1e-8);
        EXPECT_NEAR(std::fabs(margin.frequency_y), fy, 1e-8);
    };
    expect_margin(IpcKernel::parametric(0.02, 0.002), 1 - 8 * 0.02, 0.5, 0.5);
    EXPECT_NEAR(IpcKernel::parametric(0.01, 0.02).margin().value, 1 - 4 * 0.01 - 8 * 0.02, 1e-15);
    expect_margin(IpcKernel::parametric(0.01, 0.02, 0.002), 1 - 4 * 0.012 - 8 * 0.02, 0.5, 0);
    for (const double margin : {1e-3, 1e-6, 1e-12})
        expect_margin(IpcKernel::parametric((1 - margin) / 8), margin, 0.5, 0.5);
    // A minimum between the points of any grid: K^ = (1 - 2b) + 2b cos(2 pi 3f) is least at 1/6.
    const double taps[7] = {0.1, 0, 0, 0.8, 0, 0, 0.1};
    const StabilityMargin row = IpcKernel::from_table({taps, 7, 1, 1, 7}).margin();
    EXPECT_NEAR(row.value, 0.6, 1e-15);
    EXPECT_NEAR(std::fabs(std::remainder(3 * row.frequency_x, 1.0)), 0.5, 1e-7);
}

TEST(IpcKernel, AlgebraIsProductsOfTransforms) {
    const double taps[15] = {0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.44,
                             0.08, 0.09, 0.03, 0.02, 0.01, 0.02, 0.03};
    const IpcKernel a = IpcKernel::from_table({taps, 5, 3, 1, 5}),
                    b = IpcKernel::parametric(0.02, 0.003, 0.001);
    for (const double fx : {0.0, 0.13, 0.5})
        for (const double fy : {-0.37, 0.0, 0.25}) {
            const std::complex<double> ta = a.transform(fx, fy), tb = b.transform(fx, fy);
            std::complex<double> direct = 0;
            for (int64_t dy = -1; dy <= 1; ++dy)
                for (int64_t dx = -2; dx <= 2; ++dx)
                    direct += a(dx, dy) * std::polar(1.0, -2 * M_PI *
                                                              (fx * static_cast<double>(dx) +
                                                               fy * static_cast<double>(dy)));
            EXPECT_NEAR(std::abs(ta - direct), 0, 1e-15);
            EXPECT_NEAR(std::abs(a.composed(b).transform(fx, fy) - ta * tb), 0, 1e-15);
            EXPECT_NEAR(std::abs(a.autocorrelation().transform(fx, fy) - std::norm(ta)), 0, 1e-15);
            std::complex<double> series = 0;
            for (int n = 0; n < 5; ++n) {
                series += std::pow(1.0 - tb, n);
                EXPECT_NEAR(std::abs(b.neumann_correction(n).transform(fx, fy) - series), 0, 2e-15);
            }
        }
    EXPECT_NEAR(a.autocorrelation()(0, 0), a.sum_of_squares(), 1e-16);
    for (int64_t dy = -1; dy <= 1; ++dy)
        for (int64_t dx = -1; dx <= 1; ++dx)
            EXPECT_NEAR(b.neumann_correction(1)(dx, dy), b.first_order_correction()(dx, dy), 1e-16);
    EXPECT_NEAR(a.composed(b).moments().xx, a.moments().xx + b.moments().xx, 1e-15);
}

// Order n leaves an error of order n + 1 in the coupling.
TEST(IpcKernel, NeumannConvergesAsItsOrder) {
    const IpcKernel kernel = IpcKernel::parametric(0.02, 0.002);
    for (int order = 0; order < 8; ++order) {
        const IpcKernel rest = kernel.neumann_correction(order).composed(kernel);
        EXPECT_NEAR(rest.transform(0.5, 0.5).real(), 1 - std::pow(8 * 0.02, order + 1), 1e-14);
    }
}

TEST(IpcKernel, AsymmetryIsMeasured) {
    const KernelAsymmetry none = IpcKernel::parametric(0.02, 0.002).asymmetry();
    EXPECT_EQ(none.left_right + none.up_down + none.half_turn + none.transposed, 0);
    const KernelAsymmetry plus = IpcKernel::parametric(0.02, 0.002, 0.003).asymmetry();
    EXPECT_EQ(plus.left_right + plus.up_down + plus.half_turn, 0);
    EXPECT_NEAR(plus.transposed, 0.006, 1e-16);
    const KernelAsymmetry wfc3 = IpcKernel::wfc3().asymmetry();
    EXPECT_NEAR(wfc3.left_right, 0.0001 / 0.9985, 1e-16);
    EXPECT_EQ(wfc3.up_down, 0);
    const double row[3] = {0.1, 0.8, 0.1};
    EXPECT_EQ(IpcKernel::from_table({row, 3, 1, 1, 3}).asymmetry().transposed, HUGE_VAL);
}

TEST(IpcKernel, Wfc3AgreesWithTheParametersWithinItsDeviations) {
    const auto deviation = wfc3_uncertainties();
    const IpcKernel wfc3 = IpcKernel::wfc3(), model = IpcKernel::parametric(0.0146, 0.0011, 0.0018);
    for (int64_t i = 0; i < 9; ++i)
        EXPECT_LE(std::fabs(wfc3(i % 3 - 1, i / 3 - 1) - model(i % 3 - 1, i / 3 - 1)),
                  deviation[static_cast<size_t>(i)]);
}

TEST(IpcKernel, NormalisedSumIsOneToRounding) {
    std::vector<double> taps(101 * 101);
    for (size_t i = 0; i < taps.size(); ++i)
        taps[i] = 1 + std::sin(static_cast<double>(i));
    const IpcKernel k = IpcKernel::from_table({taps.data(), 101, 101, 1, 101}, {.normalise = true});
    long double sum = 0;
    for (int64_t dy = -50; dy <= 50; ++dy)
        for (int64_t dx = -50; dx <= 50; ++dx)
            sum += k(dx, dy);
    EXPECT_NEAR(static_cast<double>(sum), 1, 1e-13);
}

} // namespace
} // namespace wfpsf
