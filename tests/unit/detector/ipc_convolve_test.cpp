// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/ipc_convolve.hpp"
#include "error/error.hpp"
#include "image/interleave.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

namespace wfpsf {
namespace {

const Edge all_edges[] = {Edge::zero, Edge::replicate, Edge::wrap,
                          Edge::crop, Edge::fill,      Edge::valid};
const double fill_value = -3.5;

// A kernel without any symmetry, with a negative and a zero tap.
IpcKernel asymmetric(int64_t nx, int64_t ny) {
    std::vector<double> taps(static_cast<size_t>(nx * ny));
    for (size_t i = 0; i < taps.size(); ++i)
        taps[i] = 0.01 * (1 + std::sin(3.0 + 2.0 * static_cast<double>(i)));
    taps[taps.size() / 2] = 0.9;
    if (taps.size() > 2) {
        taps[0] = -0.02;
        taps[1] = 0;
    }
    return IpcKernel::from_table({taps.data(), nx, ny, 1, nx},
                                 {.allow_negative = true, .normalise = true});
}

// An image in memory of its own that is read through strides of some kind.
template <class T> struct Strided {
    static constexpr int kinds = 4;
    Strided(int64_t nx, int64_t ny, int kind)
        : memory(static_cast<size_t>(2 * (nx + 1) * (ny + 1)), T(-99)) {
        T *first = memory.data();
        switch (kind) {
        case 0: // contiguous
            view = {first, nx, ny, 1, nx};
            break;
        case 1: // turned by 180 degrees
            view = {first + std::max<int64_t>(nx * ny - 1, 0), nx, ny, -1, -nx};
            break;
        case 2: // every other sample, rows padded
            view = {first, nx, ny, 2, 2 * nx + 1};
            break;
        default: // transposed, left to right
            view = {first + std::max<int64_t>(nx - 1, 0) * (ny + 1), nx, ny, -(ny + 1), 1};
            break;
        }
    }
    std::vector<T> memory;
    View<T> view;
};

template <class T> void fill_with_waves(View<T> image) {
    for (int64_t y = 0; y < image.ny; ++y)
        for (int64_t x = 0; x < image.nx; ++x)
            image(x, y) = static_cast<T>(
                1000 * std::sin(0.7 * static_cast<double>(x * x) + 1.3 * static_cast<double>(y)) +
                300);
}

// The sample of one axis at distance `moves` whole native pixels from sample x, -1 if none: written
// on the phases of the image, apart from how convolve() does it.
int64_t moved(int64_t x, int64_t moves, int64_t tap_step, int64_t n, Edge edge) {
    if (edge == Edge::wrap) {
        const int64_t position = (x + moves * tap_step) % n;
        return position < 0 ? position + n : position;
    }
    const int64_t phase = x % tap_step, samples = (n - phase + tap_step - 1) / tap_step;
    int64_t native = x / tap_step + moves;
    if (edge == Edge::replicate)
        native = std::clamp<int64_t>(native, 0, samples - 1);
    return native < 0 || native >= samples ? -1 : phase + tap_step * native;
}

template <class T>
long double brute_force(const IpcKernel &kernel, View<const T> in, Edge edge, int64_t tap_step,
                        int64_t x, int64_t y) {
    const int64_t margin_x = kernel.reach_x() * tap_step, margin_y = kernel.reach_y() * tap_step;
    const bool border =
        x < margin_x || x >= in.nx - margin_x || y < margin_y || y >= in.ny - margin_y;
    if (border && edge == Edge::crop)
        return in(x, y);
    if (border && edge == Edge::fill)
        return fill_value;
    long double sum = 0;
    for (int64_t dy = -kernel.reach_y(); dy <= kernel.reach_y(); ++dy) {
        for (int64_t dx = -kernel.reach_x(); dx <= kernel.reach_x(); ++dx) {
            const int64_t from_x = moved(x, -dx, tap_step, in.nx, edge);
            const int64_t from_y = moved(y, -dy, tap_step, in.ny, edge);
            if (from_x >= 0 && from_y >= 0)
                sum += static_cast<long double>(kernel(dx, dy)) * in(from_x, from_y);
        }
    }
    return sum;
}

template <class T>
Plane<T> convolved(const IpcKernel &kernel, View<const T> in, Edge edge, int64_t tap_step = 1) {
    const int64_t trim = edge == Edge::valid ? 2 * tap_step : 0;
    Plane<T> out(std::max<int64_t>(in.nx - trim * kernel.reach_x(), 0),
                 std::max<int64_t>(in.ny - trim * kernel.reach_y(), 0));
    convolve(kernel, in, {edge, fill_value, tap_step}, out.view());
    return out;
}

template <class T> void compare_with_brute_force(const IpcKernel &kernel) {
    const double tolerance = std::is_same_v<T, float> ? 1e-7 * 1300 : 1e-15 * 1300;
    struct {
        int64_t nx, ny;
    } const sizes[] = {{1, 1}, {1, 7}, {7, 1}, {2, 2}, {5, 3}, {17, 13}, {0, 0}, {0, 4}, {4, 0}};
    for (const auto size : sizes) {
        for (int kind = 0; kind < Strided<T>::kinds; ++kind) {
            const Strided<T> in(size.nx, size.ny, kind);
            fill_with_waves(in.view);
            for (const Edge edge : all_edges) {
                for (const int64_t tap_step : {1, 2, 5, 1000}) {
                    const int64_t x0 = edge == Edge::valid ? kernel.reach_x() * tap_step : 0;
                    const int64_t y0 = edge == Edge::valid ? kernel.reach_y() * tap_step : 0;
                    const Strided<T> out(std::max<int64_t>(size.nx - 2 * x0, 0),
                                         std::max<int64_t>(size.ny - 2 * y0, 0),
                                         (kind + 1) % Strided<T>::kinds);
                    convolve(kernel, in.view, {edge, fill_value, tap_step}, out.view);
                    for (int64_t y = 0; y < out.view.ny; ++y)
                        for (int64_t x = 0; x < out.view.nx; ++x)
                            ASSERT_NEAR(out.view(x, y),
                                        static_cast<double>(brute_force<T>(
                                            kernel, in.view, edge, tap_step, x + x0, y + y0)),
                                        tolerance)
                                << size.nx << " x " << size.ny << ", strides " << kind << ", edge "
                                << static_cast<int>(edge) << ", tap_step " << tap_step << ", at ("
                                << x << ", " << y << ")";
                    const auto written = std::count_if(out.memory.begin(), out.memory.end(),
                                                       [](T pixel) { return pixel != T(-99); });
                    ASSERT_EQ(written, out.view.nx * out.view.ny);
                }
            }
        }
    }
}

TEST(IpcConvolve, AgreesWithBruteForceInDouble) {
    compare_with_brute_force<double>(asymmetric(3, 3));
    compare_with_brute_force<double>(asymmetric(5, 3));
    compare_with_brute_force<double>(asymmetric(1, 7));
    compare_with_brute_force<double>(asymmetric(1, 1));
    compare_with_brute_force<double>(IpcKernel::parametric(0.02, 0.002, 0.001));
}

TEST(IpcConvolve, AgreesWithBruteForceInFloat) {
    compare_with_brute_force<float>(asymmetric(3, 3));
    compare_with_brute_force<float>(IpcKernel::parametric(0.02, 0.002));
}

TEST(IpcConvolve, RowsLongerThanABlock) {
    Plane<double> in(1100, 4);
    fill_with_waves(in.view());
    const IpcKernel kernel = asymmetric(3, 3);
    for (const Edge edge : {Edge::wrap, Edge::valid}) {
        const Plane<double> out = convolved<double>(kernel, in.view(), edge);
        const int64_t first = edge == Edge::valid ? 1 : 0;
        for (int64_t y = 0; y < out.ny(); ++y)
            for (int64_t x = 0; x < out.nx(); ++x)
                ASSERT_NEAR(out(x, y),
                            static_cast<double>(brute_force<double>(kernel, in.view(), edge, 1,
                                                                    x + first, y + first)),
                            1.3e-12);
    }
}

TEST(IpcConvolve, PointChargeShowsTheKernelAsItIs) {
    const IpcKernel kernel = asymmetric(5, 3);
    Plane<double> in(9, 9);
    in(4, 5) = 1;
    for (const Edge edge : {Edge::zero, Edge::replicate, Edge::wrap, Edge::crop}) {
        const Plane<double> out = convolved<double>(kernel, in.view(), edge);
        for (int64_t dy = -1; dy <= 1; ++dy)
            for (int64_t dx = -2; dx <= 2; ++dx)
                EXPECT_EQ(out(4 + dx, 5 + dy), kernel(dx, dy));
    }
}

TEST(IpcConvolve, AlphaPlusWidensAlongX) {
    Plane<double> in(5, 5);
    in(2, 2) = 1;
    const Plane<double> out =
        convolved<double>(IpcKernel::parametric(0.02, 0.002, 0.005), in.view(), Edge::zero);
    EXPECT_GT(out(3, 2), out(2, 3));
}

// The centroid and covariance of an image grow by the kernel's.
TEST(IpcConvolve, AddsTheMomentsOfTheKernel) {
    struct Sums {
        double flux = 0, x = 0, xx = 0, xy = 0;
        explicit Sums(View<const double> image) {
            for (int64_t y = 0; y < image.ny; ++y)
                for (int64_t i = 0; i < image.nx; ++i)
                    flux += image(i, y), x += image(i, y) * static_cast<double>(i);
            x /= flux;
            double mean_y = 0;
            for (int64_t y = 0; y < image.ny; ++y)
                for (int64_t i = 0; i < image.nx; ++i)
                    mean_y += image(i, y) * static_cast<double>(y) / flux;
            for (int64_t y = 0; y < image.ny; ++y) {
                for (int64_t i = 0; i < image.nx; ++i) {
                    const double u = static_cast<double>(i) - x;
                    xx += image(i, y) * u * u / flux;
                    xy += image(i, y) * u * (static_cast<double>(y) - mean_y) / flux;
                }
            }
        }
    };
    Plane<double> in(15, 11);
    in(6, 5) = 3;
    in(8, 6) = 1;
    in(7, 4) = 2;
    const IpcKernel kernel = asymmetric(3, 3);
    const Plane<double> out = convolved<double>(kernel, in.view(), Edge::zero);
    const Sums before(in.view()), after(out.view());
    const KernelMoments added = kernel.moments();
    EXPECT_NEAR(after.flux, before.flux, 1e-14);
    EXPECT_NEAR(after.x, before.x + added.x, 1e-14);
    EXPECT_NEAR(after.xx, before.xx + added.xx, 1e-14);
    EXPECT_NEAR(after.xy, before.xy + added.xy, 1e-14);
}

TEST(IpcConvolve, WrapConservesCharge) {
    Plane<double> in(17, 13);
    fill_with_waves(in.view());
    for (const int64_t tap_step : {1, 2, 5, 40}) {
        const Plane<double> out =
            convolved<double>(asymmetric(3, 3), in.view(), Edge::wrap, tap_step);
        long double before = 0, after = 0;
        for (int64_t y = 0; y < in.ny(); ++y)
            for (int64_t x = 0; x < in.nx(); ++x)
                before += in(x, y), after += out(x, y);
        EXPECT_NEAR(static_cast<double>(after), static_cast<double>(before),
                    1e-15 * 1300 * 17 * 13);
    }
}

// One pass with taps N samples apart equals IPC on each native image and the interleave after it,
// bit by bit, for every edge.
TEST(IpcConvolve, OnePassEqualsTheInterleaveOfNativeImages) {
    const IpcKernel kernels[] = {asymmetric(3, 3), asymmetric(5, 3),
                                 IpcKernel::parametric(0.02, 0.002)};
    for (const int64_t n : {2, 3, 5}) {
        Plane<double> in(7 * n, 6 * n);
        fill_with_waves(in.view());
        for (const IpcKernel &kernel : kernels) {
            for (const Edge edge : all_edges) {
                const Plane<double> one_pass = convolved<double>(kernel, in.view(), edge, n);
                for (int64_t j = 0; j < n; ++j) {
                    for (int64_t i = 0; i < n; ++i) {
                        const Plane<double> native = convolved<double>(
                            kernel, phase_view(View<const double>(in.view()), n, n, i, j), edge);
                        const View<const double> phase = phase_view(one_pass.view(), n, n, i, j);
                        ASSERT_EQ(native.nx(), phase.nx);
                        ASSERT_EQ(native.ny(), phase.ny);
                        for (int64_t y = 0; y < phase.ny; ++y)
                            for (int64_t x = 0; x < phase.nx; ++x)
                                ASSERT_EQ(native(x, y), phase(x, y))
                                    << "N = " << n << ", edge " << static_cast<int>(edge);
                    }
                }
            }
        }
    }
}

template <class T> void compare_ways(int64_t nx, int64_t ny, int64_t tap_step) {
    const IpcKernel kernel = asymmetric(5, 3);
    for (const Edge edge : {Edge::zero, Edge::replicate, Edge::wrap, Edge::crop, Edge::fill}) {
        Plane<T> in(nx, ny);
        fill_with_waves(in.view());
        const Plane<T> expected = convolved<T>(kernel, in.view(), edge, tap_step);
        for (const int threads : {1, 2, 5}) {
            for (const bool flipped : {false, true}) {
                Plane<T> apart(nx, ny), both = in;
                convolve(kernel, in.view(), {edge, fill_value, tap_step, threads}, apart.view());
                const View<T> place =
                    flipped ? View<T>{&both(nx - 1, 0), nx, ny, -1, nx} : both.view();
                for (int64_t y = 0; flipped && y < ny; ++y)
                    for (int64_t x = 0; x < nx; ++x)
                        place(x, y) = in(x, y);
                convolve(kernel, place, {edge, fill_value, tap_step, threads}, place);
                for (int64_t y = 0; y < ny; ++y)
                    for (int64_t x = 0; x < nx; ++x) {
                        ASSERT_EQ(apart(x, y), expected(x, y));
                        ASSERT_EQ(place(x, y), expected(x, y))
                            << nx << " x " << ny << ", edge " << static_cast<int>(edge) << ", step "
                            << tap_step << ", threads " << threads << ", at " << x << ", " << y;
                    }
            }
        }
    }
}

TEST(IpcConvolve, InPlaceAndOnManyThreadsGivesTheSameBits) {
    for (const int64_t tap_step : {1, 2, 3, 7, 100}) {
        compare_ways<double>(23, 17, tap_step);
        compare_ways<double>(1, 9, tap_step);
        compare_ways<double>(2, 1, tap_step);
        compare_ways<float>(600, 9, tap_step);
    }
}

TEST(IpcConvolve, AWholeDetectorAndMoreKeepsItsCharge) {
    constexpr int64_t n = 8192;
    Plane<float> image(n, n);
    for (int64_t i = 0; i < n; ++i)
        image(i, (i * i) % n) = 1024;
    convolve(IpcKernel::parametric(0.02, 0.002, 0.001), image.view(),
             {.edge = Edge::wrap, .threads = 2}, image.view());
    double sum = 0;
    for (int64_t y = 0; y < n; ++y)
        for (int64_t x = 0; x < n; ++x)
            sum += static_cast<double>(image(x, y));
    EXPECT_NEAR(sum / (1024.0 * n), 1, 1e-7);
}

TEST(IpcConvolve, HugeNegativeAndInfinitePixelsStayWhatTheyAre) {
    const IpcKernel kernel = IpcKernel::parametric(0.02, 0.002);
    Plane<float> in(9, 9), out(9, 9);
    for (int64_t y = 0; y < 9; ++y)
        for (int64_t x = 0; x < 9; ++x)
            in(x, y) = -1e30F;
    in(1, 1) = std::numeric_limits<float>::infinity();
    convolve(kernel, in.view(), {.edge = Edge::replicate}, out.view());
    for (int64_t y = 0; y < 9; ++y)
        for (int64_t x = 0; x < 9; ++x) {
            if (x <= 2 && y <= 2)
                EXPECT_EQ(out(x, y), std::numeric_limits<float>::infinity());
            else
                EXPECT_FLOAT_EQ(out(x, y), -1e30F);
        }
}

TEST(IpcConvolve, ZeroTapsDoNotSpreadNaN) {
    Plane<double> in(7, 7);
    in(3, 3) = std::numeric_limits<double>::quiet_NaN();
    const Plane<double> out = convolved<double>(IpcKernel::parametric(0.02), in.view(), Edge::zero);
    int64_t touched = 0;
    for (int64_t y = 0; y < 7; ++y)
        for (int64_t x = 0; x < 7; ++x)
            touched += std::isnan(out(x, y)) ? 1 : 0;
    EXPECT_EQ(touched, 5);
    EXPECT_FALSE(std::isnan(out(4, 4)));
}

TEST(IpcConvolve, FillMayBeNaN) {
    Plane<float> in(4, 4), out(4, 4);
    convolve(IpcKernel::parametric(0.02), in.view(),
             {Edge::fill, std::numeric_limits<double>::quiet_NaN()}, out.view());
    EXPECT_TRUE(std::isnan(out(0, 2)));
    EXPECT_EQ(out(1, 2), 0);
}

TEST(IpcConvolve, FloatIsSummedInDouble) {
    Plane<float> in(3, 3);
    for (int64_t y = 0; y < 3; ++y)
        for (int64_t x = 0; x < 3; ++x)
            in(x, y) = 16777215.0F;
    const Plane<float> out =
        convolved<float>(IpcKernel::parametric(0.02, 0.002), in.view(), Edge::wrap);
    EXPECT_EQ(out(1, 1), 16777215.0F);
}

TEST(IpcConvolve, RefusesBadArguments) {
    Plane<double> pixels(8, 8), out(8, 8);
    const IpcKernel kernel = IpcKernel::parametric(0.02);
    const auto status_of = [&](Edge edge, double fill, int64_t tap_step, View<double> to) {
        try {
            convolve(kernel, pixels.view(), {edge, fill, tap_step}, to);
        } catch (const Error &error) {
            return error.status();
        }
        return wfpsf_status{WFPSF_OK};
    };
    EXPECT_EQ(status_of(Edge::zero, 0, 1, out.view()), WFPSF_OK);
    EXPECT_EQ(status_of(Edge(6), 0, 1, out.view()), WFPSF_ERROR_ARGUMENT);
    EXPECT_EQ(status_of(Edge(-1), 0, 1, out.view()), WFPSF_ERROR_ARGUMENT);
    EXPECT_EQ(status_of(Edge::zero, 0, 0, out.view()), WFPSF_ERROR_RANGE);
    EXPECT_EQ(status_of(Edge::valid, 0, 1, out.view()), WFPSF_ERROR_SIZE);
    EXPECT_EQ(status_of(Edge::valid, 0, 3, {&out(0, 0), 2, 2, 1, 2}), WFPSF_OK);
    EXPECT_EQ(status_of(Edge::valid, 0, 4, {&out(0, 0), 0, 0, 1, 1}), WFPSF_OK);
    EXPECT_EQ(status_of(Edge::valid, 0, std::numeric_limits<int64_t>::max(), {}), WFPSF_OK);
    EXPECT_EQ(status_of(Edge::zero, 0, 1, {&pixels(7, 7), 8, 8, -1, -8}), WFPSF_ERROR_OVERLAP);

    Plane<float> in_float(2, 2), out_float(2, 2);
    EXPECT_THROW(convolve(kernel, in_float.view(), {Edge::fill, 1e39}, out_float.view()), Error);
}

// Figures of GalSim 2.8.4's Image.applyIPC, which is a correlation, so the kernel is flipped.
IpcKernel galsim_kernel() {
    const double taps[9] = {0.027966393784383915, 0.024255288765400864, 0.009714103873917631,
                            0.007774809089650953, 0.8814976292121263,   0.006858051555270341,
                            0.012194638202520555, 0.009768756726928783, 0.01997032878980072};
    return IpcKernel::from_table({taps, 3, 3, 1, 3}).flipped();
}

void compare_with_galsim(const double *in, const double *expected, int64_t nx, int64_t ny,
                         Edge edge) {
    const Plane<double> out = convolved<double>(galsim_kernel(), {in, nx, ny, 1, nx}, edge);
    const double largest = *std::max_element(expected, expected + nx * ny);
    for (int64_t y = 0; y < ny; ++y)
        for (int64_t x = 0; x < nx; ++x)
            EXPECT_NEAR(out(x, y), expected[y * nx + x], 1e-14 * largest) << x << ", " << y;
}

TEST(IpcConvolve, AgreesWithGalSim) {
    const double ramp[48] = {3,   5,   7,   9,   11,  13,  53,  55,  57,  59,  61,  63,
                             103, 105, 107, 109, 111, 113, 153, 155, 157, 159, 161, 163,
                             203, 205, 207, 209, 211, 213, 253, 255, 257, 259, 261, 263,
                             303, 305, 307, 309, 311, 313, 353, 355, 357, 359, 361, 363};
    const double ramp_extend[48] = {
        4.294895335378996,  6.8007251199497905, 8.676853547102386,  10.55298197425498,
        12.429110401407575, 12.904296683894069, 50.320970035251094, 53.977110151062256,
        55.97711015106225,  57.977110151062256, 59.97711015106224,  59.08903743103383,
        97.92417798142331,  103.97711015106225, 105.97711015106225, 107.97711015106225,
        109.97711015106226, 107.26191322008441, 145.52738592759556, 153.97711015106228,
        155.97711015106228, 157.97711015106225, 159.97711015106222, 155.43478900913496,
        193.13059387376776, 203.97711015106228, 205.97711015106225, 207.97711015106225,
        209.97711015106225, 203.60766479818554, 240.73380181994003, 253.97711015106225,
        255.97711015106228, 257.9771101510622,  259.9771101510623,  251.7805405872361,
        288.3370097661122,  303.9771101510622,  305.9771101510623,  307.97711015106216,
        309.9771101510622,  299.95341637628667, 323.91542559146285, 336.97840066359146,
        338.8945332161529,  340.81066576871433, 342.7267983212759,  339.07979933587967};
    const double ramp_wrap[48] = {
        27.32665481346188,  28.751424720543213, 30.751424720543216, 32.751424720543206,
        34.75142472054321,  36.31291490991535,  52.552340243980915, 53.977110151062256,
        55.97711015106225,  57.977110151062256, 59.97711015106224,  61.538600340434385,
        102.55234024398092, 103.97711015106225, 105.97711015106225, 107.97711015106225,
        109.97711015106226, 111.5386003404344,  152.55234024398095, 153.97711015106228,
        155.97711015106228, 157.97711015106225, 159.97711015106222, 161.5386003404344,
        202.55234024398092, 203.97711015106228, 205.97711015106225, 207.97711015106225,
        209.97711015106225, 211.5386003404344,  252.55234024398092, 253.97711015106225,
        255.97711015106228, 257.9771101510622,  259.9771101510623,  261.53860034043436,
        302.5523402439809,  303.9771101510622,  305.9771101510623,  307.97711015106216,
        309.9771101510622,  311.5386003404344,  335.77885075628086, 337.20362066336224,
        339.20362066336224, 341.20362066336224, 343.20362066336224, 344.7651108527344};
    const double point_wrap[63] = {7.774809089650953,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   6.858051555270341,
                                   881.4976292121263,
                                   27.966393784383914,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   9.714103873917631,
                                   24.255288765400863,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   12.194638202520554,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   0,
                                   19.97032878980072,
                                   9.768756726928784};
    compare_with_galsim(ramp, ramp_extend, 6, 8, Edge::zero);
    compare_with_galsim(ramp, ramp_wrap, 6, 8, Edge::wrap);
    double point[63] = {};
    point[8] = 1000;
    compare_with_galsim(point, point_wrap, 9, 7, Edge::wrap);
}

// A point charge of 1000 after IPC and its first-order correction (Eq. 12), from GalSim 2.8.4.
TEST(IpcConvolve, FirstOrderCorrectionAgreesWithGalSim) {
    const double expected[25] = {-0.004,
                                 -0.07200000000000001,
                                 -0.33200000000000013,
                                 -0.07200000000000001,
                                 -0.004,
                                 -0.088,
                                 -0.4400000000000001,
                                 2.992000000000005,
                                 -0.43999999999999995,
                                 -0.088,
                                 -0.492,
                                 3.7280000000000006,
                                 990.624,
                                 3.7280000000000006,
                                 -0.492,
                                 -0.088,
                                 -0.44000000000000017,
                                 2.992000000000005,
                                 -0.44000000000000006,
                                 -0.088,
                                 -0.004,
                                 -0.07200000000000001,
                                 -0.33200000000000013,
                                 -0.07200000000000001,
                                 -0.004};
    Plane<double> in(11, 11);
    in(5, 5) = 1000;
    const IpcKernel kernel = IpcKernel::parametric(0.02, 0.002, 0.002);
    const Plane<double> seen = convolved<double>(kernel, in.view(), Edge::zero);
    const Plane<double> out =
        convolved<double>(kernel.first_order_correction(), seen.view(), Edge::zero);
    for (int64_t y = 0; y < 5; ++y)
        for (int64_t x = 0; x < 5; ++x)
            EXPECT_NEAR(out(x + 3, y + 3), expected[5 * y + x], 1e-14 * 1000);
}

} // namespace
} // namespace wfpsf
