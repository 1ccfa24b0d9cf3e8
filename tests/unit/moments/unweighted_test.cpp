// SPDX-License-Identifier: GPL-3.0-or-later
#include "error/error.hpp"
#include "gaussian_image.hpp"
#include "moments/unweighted.hpp"

#include <gtest/gtest.h>

namespace wfpsf {
namespace {

// The IPC kernel of Kannawadi et al. 2016, Eq. 7: alpha at the four neighbours, alpha' at the
// corners. Written out here: the moments know nothing of the detector.
Plane<double> with_ipc(const Plane<double> &in, double alpha, double corner) {
    Plane<double> out(in.nx(), in.ny());
    for (int64_t y = 1; y + 1 < in.ny(); ++y)
        for (int64_t x = 1; x + 1 < in.nx(); ++x)
            out(x, y) = (1 - 4 * alpha - 4 * corner) * in(x, y) +
                        alpha * (in(x - 1, y) + in(x + 1, y) + in(x, y - 1) + in(x, y + 1)) +
                        corner * (in(x - 1, y - 1) + in(x + 1, y - 1) + in(x - 1, y + 1) +
                                  in(x + 1, y + 1));
    return out;
}

double cell(int64_t i, double c, double sigma) {
    const double scale = sigma * std::sqrt(2.0), d = static_cast<double>(i) - c;
    return (std::erf((d + 0.5) / scale) - std::erf((d - 0.5) / scale)) / 2;
}

TEST(Unweighted, ByHand) {
    Plane<double> image(3, 2);
    image(0, 0) = 1;
    image(2, 1) = 3;
    const UnweightedMoments m = unweighted_moments(view_of(image));
    EXPECT_DOUBLE_EQ(m.flux, 4);
    EXPECT_DOUBLE_EQ(m.x, 1.5);
    EXPECT_DOUBLE_EQ(m.y, 0.75);
    EXPECT_DOUBLE_EQ(m.Mxx, 0.75);
    EXPECT_DOUBLE_EQ(m.Mxy, 0.375);
    EXPECT_DOUBLE_EQ(m.Myy, 0.1875);
    const UnweightedMoments about = unweighted_moments(view_of(image), 2, 0);
    EXPECT_DOUBLE_EQ(about.Mxx, 1);
    EXPECT_DOUBLE_EQ(about.Mxy, 0);
    EXPECT_DOUBLE_EQ(about.Myy, 0.75);
    EXPECT_DOUBLE_EQ(about.radius_trace(), std::sqrt(0.875));
    EXPECT_DOUBLE_EQ(about.radius_det(), std::pow(0.75, 0.25));
}

// Eq. 22: the pixel adds 1/12 to the variance, IPC adds 2 alpha + 4 alpha'. Sums over samples of a
// pixel-averaged Gaussian of sigma = 2 are exact to 1e-17 (Poisson's formula).
TEST(Unweighted, CircularObjectsObeyThePapersRelation) {
    const double sigma = 2, alpha = 0.012, corner = 0.0015;
    Plane<double> image(60, 60);
    for (int64_t y = 0; y < 60; ++y)
        for (int64_t x = 0; x < 60; ++x)
            image(x, y) = cell(x, 29.3, sigma) * cell(y, 30.1, sigma);
    const UnweightedMoments before = unweighted_moments(view_of(image));
    EXPECT_NEAR(before.x, 29.3, 1e-13);
    EXPECT_NEAR(before.y, 30.1, 1e-13);
    EXPECT_NEAR(before.radius_det(), std::sqrt(sigma * sigma + 1.0 / 12), 1e-12);
    const Plane<double> coupled = with_ipc(image, alpha, corner);
    const UnweightedMoments after = unweighted_moments(view_of(coupled));
    EXPECT_NEAR(after.flux, before.flux, 1e-13);
    const double expected = std::sqrt(sigma * sigma + 1.0 / 12 + 2 * alpha + 4 * corner);
    EXPECT_NEAR(after.radius_det(), expected, 1e-12);
    EXPECT_NEAR(after.radius_trace(), expected, 1e-12);
}

// For any shape moment matrices add, so the size is det(M + (1/12 + 2 alpha + 4 alpha') 1)^(1/4);
// the appendix's formula for shapes that are not circular does not follow from that.
TEST(Unweighted, EllipticalObjectsAddMomentMatrices) {
    const double alpha = 0.02, corner = 0.002, added = 2 * alpha + 4 * corner;
    const Gaussian g = gaussian_of(40.2, 39.6, 3, 0.4, -0.5);
    const Plane<double> image = with_ipc(gaussian_image(80, 80, g), alpha, corner);
    const UnweightedMoments m = unweighted_moments(view_of(image));
    EXPECT_NEAR(m.Mxx, g.Mxx + added, 1e-11);
    EXPECT_NEAR(m.Mxy, g.Mxy, 1e-11);
    EXPECT_NEAR(m.Myy, g.Myy + added, 1e-11);
    EXPECT_NEAR(m.radius_det(), std::pow((g.Mxx + added) * (g.Myy + added) - g.Mxy * g.Mxy, 0.25),
                1e-11);
}

TEST(Unweighted, SumsAreCompensated) {
    // One large value, its negative, and a small object between: plain sums lose it all.
    Plane<double> image(64, 3);
    image(0, 1) = 1e17;
    image(63, 1) = -1e17;
    for (int64_t x = 1; x < 63; ++x)
        image(x, 1) = 1;
    EXPECT_DOUBLE_EQ(unweighted_moments(view_of(image), 31.5, 1).flux, 62);
}

TEST(Unweighted, BadImagesThrow) {
    Plane<double> image(4, 4);
    EXPECT_THROW(unweighted_moments(view_of(image)), Error);
    image(1, 1) = NAN;
    EXPECT_THROW(unweighted_moments(view_of(image)), Error);
    EXPECT_THROW(unweighted_moments(View<const float>{}), Error);
}

} // namespace
} // namespace wfpsf
