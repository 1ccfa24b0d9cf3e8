// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/interleave.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

namespace wfpsf {
namespace {

// A Gaussian integrated over unit pixels, its centre at (x0, y0).
double gaussian_pixel(double x, double y, double x0, double y0) {
    const auto share = [](double from_centre) {
        const double scale = 1 / (1.1 * std::sqrt(2.0));
        return (std::erf((from_centre + 0.5) * scale) - std::erf((from_centre - 0.5) * scale)) / 2;
    };
    return share(x - x0) * share(y - y0);
}

// All n m dithers of an image that is made by pixel(x, y, dx, dy).
template <class T> struct Dithers {
    template <class Pixel>
    Dithers(int64_t nx, int64_t ny, int64_t n, int64_t m, DitherConvention convention,
            Pixel pixel) {
        for (int64_t j = 0; j < m; ++j) {
            for (int64_t i = 0; i < n; ++i) {
                const auto offset = [&](int64_t phase, int64_t count) {
                    const double size = static_cast<double>(count);
                    const double shift = static_cast<double>(phase) / size;
                    return convention == DitherConvention::detector
                               ? shift
                               : (size - 1) / (2 * size) - shift;
                };
                const double dx = offset(i, n), dy = offset(j, m);
                Plane<T> &plane = planes.emplace_back(nx, ny);
                for (int64_t y = 0; y < ny; ++y)
                    for (int64_t x = 0; x < nx; ++x)
                        plane(x, y) = static_cast<T>(
                            pixel(static_cast<double>(x), static_cast<double>(y), dx, dy));
                offsets.push_back({dx, dy});
            }
        }
    }
    std::vector<DitheredImage<const T>> inputs() const {
        std::vector<DitheredImage<const T>> images;
        for (size_t k = 0; k < planes.size(); ++k)
            images.push_back({planes[k].view(), offsets[k].dx, offsets[k].dy});
        return images;
    }
    struct Offset {
        double dx, dy;
    };
    std::vector<Plane<T>> planes;
    std::vector<Offset> offsets;
};

// Interleaving equals sampling N times as densely with the response of the whole pixel.
TEST(Interleave, SamplesAreWhereTheConventionSaysTheyAre) {
    const double x0 = 3.3, y0 = 2.4;
    const int64_t n = 3, m = 2;
    Plane<double> out(7 * n, 6 * m);

    const Dithers<double> of_detector(7, 6, n, m, DitherConvention::detector,
                                      [&](double x, double y, double dx, double dy) {
                                          return gaussian_pixel(x + dx, y + dy, x0, y0);
                                      });
    interleave(of_detector.inputs(), n, m, DitherConvention::detector, InterleavedFlux::sum,
               out.view());
    for (int64_t y = 0; y < out.ny(); ++y)
        for (int64_t x = 0; x < out.nx(); ++x)
            ASSERT_NEAR(
                out(x, y),
                gaussian_pixel(static_cast<double>(x) / 3, static_cast<double>(y) / 2, x0, y0),
                1e-15);

    // The centre of the interleaved image is the centre of the images without offset.
    const Dithers<double> of_object(7, 6, n, m, DitherConvention::object,
                                    [&](double x, double y, double dx, double dy) {
                                        return gaussian_pixel(x, y, x0 + dx, y0 + dy);
                                    });
    interleave(of_object.inputs(), n, m, DitherConvention::object, InterleavedFlux::sum,
               out.view());
    for (int64_t y = 0; y < out.ny(); ++y)
        for (int64_t x = 0; x < out.nx(); ++x)
            ASSERT_NEAR(out(x, y),
                        gaussian_pixel(3 + (static_cast<double>(x) - 10) / 3,
                                       2.5 + (static_cast<double>(y) - 5.5) / 2, x0, y0),
                        1e-15);
}

// As GalSim 2.8.4's interleaveImages has it (labelled pixels): a larger dx, a smaller column.
TEST(Interleave, ObjectConventionOrdersAsGalSim) {
    const double first[2] = {1011, 1012}, second[2] = {2011, 2012};
    const std::vector<DitheredImage<const double>> images = {{{first, 2, 1, 1, 2}, -0.25, 0},
                                                             {{second, 2, 1, 1, 2}, 0.25, 0}};
    Plane<double> out(4, 1);
    interleave(images, 2, 1, DitherConvention::object, InterleavedFlux::sum, out.view());
    const double expected[4] = {2011, 1011, 2012, 1012};
    for (int64_t x = 0; x < 4; ++x)
        EXPECT_EQ(out(x, 0), expected[x]);
    interleave(images, 2, 1, DitherConvention::object, InterleavedFlux::mean, out.view());
    for (int64_t x = 0; x < 4; ++x)
        EXPECT_EQ(out(x, 0), expected[x] / 2);
}

template <class T> void there_and_back(DitherConvention convention) {
    const int64_t n = 4, m = 3;
    const Dithers<T> dithers(5, 6, n, m, convention, [](double x, double y, double dx, double dy) {
        return 100 * x + 10 * y + dx + 3 * dy;
    });
    // The interleaved image is turned by 180 degrees in memory.
    std::vector<T> memory(static_cast<size_t>(5 * n * 6 * m));
    const View<T> out = {&memory.back(), 5 * n, 6 * m, -1, -5 * n};
    interleave(dithers.inputs(), n, m, convention, InterleavedFlux::sum, out);

    std::vector<Plane<T>> planes;
    std::vector<DitheredImage<T>> images;
    for (const auto offset : dithers.offsets)
        images.push_back({planes.emplace_back(5, 6).view(), offset.dx, offset.dy});
    deinterleave(out, n, m, convention, InterleavedFlux::sum, images);
    for (size_t k = 0; k < planes.size(); ++k)
        for (int64_t y = 0; y < 6; ++y)
            for (int64_t x = 0; x < 5; ++x)
                ASSERT_EQ(planes[k](x, y), dithers.planes[k](x, y));

    // One image alone, its flux restored.
    Plane<T> last(5, 6);
    deinterleave(out, n, m, convention, InterleavedFlux::mean,
                 std::vector<DitheredImage<T>>{{last.view(), images[11].dx, images[11].dy}});
    EXPECT_EQ(last(2, 3), dithers.planes[11](2, 3) * 12);
}

TEST(Interleave, ThereAndBack) {
    for (auto convention : {DitherConvention::detector, DitherConvention::object}) {
        there_and_back<double>(convention);
        there_and_back<float>(convention);
    }
}

TEST(Interleave, PhaseViewSharesThePixels) {
    Plane<double> image(7, 5);
    const View<double> phase = phase_view(image.view(), 3, 2, 1, 1);
    EXPECT_EQ(phase.nx, 2);
    EXPECT_EQ(phase.ny, 2);
    EXPECT_EQ(&phase(1, 1), &image(4, 3));
    EXPECT_EQ(phase_view(image.view(), 3, 2, 0, 0).nx, 3);
    EXPECT_EQ(phase_view(image.view(), 9, 2, 8, 0).nx, 0);
    EXPECT_THROW(phase_view(image.view(), 3, 2, 3, 0), Error);
    EXPECT_THROW(phase_view(image.view(), 3, 2, 0, -1), Error);
    EXPECT_THROW(phase_view(image.view(), 0, 2, 0, 0), Error);
}

struct Refusal {
    wfpsf_status status = WFPSF_OK;
    std::string line;
};

Refusal refusal_of(const std::vector<DitheredImage<const double>> &images, View<double> out,
                   int64_t n = 2, int64_t m = 1) {
    try {
        interleave(images, n, m, DitherConvention::detector, InterleavedFlux::sum, out);
    } catch (const Error &error) {
        return {error.status(), error.what()};
    }
    return {};
}

TEST(Interleave, RefusalsNameTheImage) {
    Plane<double> a(2, 2), b(2, 2), small(1, 2), out(4, 2);
    const View<const double> va = a.view(), vb = b.view(), vsmall = small.view();

    EXPECT_EQ(refusal_of({{va, 0, 0}, {vb, 0.5 + 0.9e-8, 0}}, out.view()).status, WFPSF_OK);
    for (double dx : {0.3, 0.5 + 2e-8, 1.0, -0.5}) {
        const Refusal refusal = refusal_of({{va, 0, 0}, {vb, dx, 0}}, out.view());
        EXPECT_EQ(refusal.status, WFPSF_ERROR_RANGE);
        EXPECT_NE(refusal.line.find("image 1: dx = "), std::string::npos) << refusal.line;
    }
    const Refusal twice = refusal_of({{va, 0.5, 0}, {vb, 0.5, 0}}, out.view());
    EXPECT_EQ(twice.status, WFPSF_ERROR_ARGUMENT);
    EXPECT_NE(twice.line.find("images 0 and 1"), std::string::npos) << twice.line;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(refusal_of({{va, 0, nan}, {vb, 0.5, 0}}, out.view()).status, WFPSF_ERROR_NOT_FINITE);
    EXPECT_EQ(refusal_of({{va, 0, 0}, {vsmall, 0.5, 0}}, out.view()).status, WFPSF_ERROR_SIZE);
    EXPECT_EQ(refusal_of({{va, 0, 0}}, out.view()).status, WFPSF_ERROR_SIZE);
    EXPECT_EQ(refusal_of({}, out.view()).status, WFPSF_ERROR_SIZE);
    EXPECT_EQ(refusal_of({{va, 0, 0}, {vb, 0.5, 0}}, a.view()).status, WFPSF_ERROR_SIZE);
    EXPECT_EQ(refusal_of({{va, 0, 0}, {vb, 0.5, 0}}, out.view(), 0, 1).status, WFPSF_ERROR_RANGE);
    const View<const double> left = {&out(0, 0), 2, 2, 1, 4};
    EXPECT_EQ(refusal_of({{va, 0, 0}, {left, 0.5, 0}}, out.view()).status, WFPSF_ERROR_OVERLAP);
}

TEST(Interleave, EmptyImagesMakeAnEmptyImage) {
    EXPECT_EQ(refusal_of({{{}, 0, 0}, {{}, 0.5, 0}}, {}).status, WFPSF_OK);
}

} // namespace
} // namespace wfpsf
