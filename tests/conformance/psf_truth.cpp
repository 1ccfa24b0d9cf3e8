// SPDX-License-Identifier: GPL-3.0-or-later
#include "psf_truth.hpp"

#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <regex>

Options precise_options(bool struts) {
    Options options = make_options();
    require(wfpsf_options_set_real(options.get(), WFPSF_OPTION_EPS, 1e-9));
    require(wfpsf_options_set_real(options.get(), WFPSF_OPTION_PSF_RADIUS, 17));
    require(wfpsf_options_set_integer(options.get(), WFPSF_OPTION_STRUTS, struts));
    return options;
}

Pixels draw_field(const Psf &psf, int native_pixels) {
    const int side = native_pixels * oversampling;
    Pixels field(side, side, oversampling);
    const double centre = (side - 1) / 2.0;
    require(wfpsf_psf_draw(psf.get(), centre, centre, 1, nullptr, field.image.get()));
    return field;
}

namespace {

// alpha, alpha', alpha_plus
struct Ipc {
    double alpha = 0.02, alpha_prime = 0.002, alpha_plus = 0;
};

Pixels blurred_by(const Pixels &field, const Ipc &ipc) {
    const Kernel kernel = make_kernel(ipc.alpha, ipc.alpha_prime, ipc.alpha_plus);
    Pixels blurred(field.nx, field.ny, oversampling);
    require(wfpsf_ipc_apply(kernel.get(), field.image.get(), WFPSF_EDGE_ZERO, nullptr,
                            blurred.image.get(), nullptr));
    return blurred;
}

Moments measure_precisely(const Pixels &pixels) {
    const Options options = make_options();
    require(wfpsf_options_set_real(options.get(), WFPSF_OPTION_MOMENTS_TOLERANCE, 1e-11));
    wfpsf_moments *handle = nullptr;
    require(wfpsf_moments_measure(pixels.image.get(), options.get(), &handle));
    return Moments(handle);
}

// Analytic derivatives at the nominal IPC. The image is linear in the kernel's parameters, so its
// derivative by one is a difference over any step.
void expect_sensitivity(const Pixels &field, const Row &row, const std::string &parameter,
                        double Ipc::*member, double tolerance) {
    SCOPED_TRACE("sensitivity to " + parameter);
    constexpr double step = 1e-3;
    Ipc more, less;
    more.*member += step;
    less.*member -= step;
    const Pixels nominal = blurred_by(field, {}), up = blurred_by(field, more),
                 down = blurred_by(field, less);
    Pixels change(field.nx, field.ny, oversampling);
    for (size_t i = 0; i < change.data.size(); ++i)
        change.data[i] = (up.data[i] - down.data[i]) / (2 * step);
    const Moments m = measure_precisely(nominal);
    wfpsf_moments *handle = nullptr;
    require(wfpsf_moments_differentiate(m.get(), nominal.image.get(), change.image.get(), nullptr,
                                        &handle));
    const Moments slopes(handle);
    const auto get = [](const Moments &moments, int32_t key) {
        double value = 0;
        require(wfpsf_moments_get(moments.get(), key, &value));
        return value;
    };
    EXPECT_NEAR(get(slopes, WFPSF_MOMENTS_SIGMA) / get(m, WFPSF_MOMENTS_SIGMA),
                row.number("R_" + parameter), tolerance);
    EXPECT_NEAR(get(slopes, WFPSF_MOMENTS_E1), row.number("S1_" + parameter), tolerance);
    EXPECT_NEAR(get(slopes, WFPSF_MOMENTS_E2), row.number("S2_" + parameter), tolerance);
}

void expect_half_light(const Pixels &field, const Ellipse &m, const Row &row, int32_t method) {
    SCOPED_TRACE("half-light radius, method " + std::to_string(method));
    double about_centroid = 0, about_centre = 0;
    const double shift = (static_cast<double>(field.nx) - 1) / 2;
    require(wfpsf_size_ee_radius(field.image.get(), m.x + shift, m.y + shift, 0.5, method, nullptr,
                                 &about_centroid, nullptr));
    require(wfpsf_size_ee_radius(field.image.get(), shift, shift, 0.5, method, nullptr,
                                 &about_centre, nullptr));
    EXPECT_NEAR(about_centroid * sample_mas, row.number("hlr_centroid_mas"), 1);
    EXPECT_NEAR(about_centre * sample_mas, row.number("hlr_center_mas"), 1);
}

double sum(const Pixels &field) {
    double total = 0;
    for (const double sample : field.data)
        total += sample;
    return total;
}

void expect_row(const Psf &psf, const Row &row, const Tolerances &tolerances) {
    const Pixels field = draw_field(psf, 16), wide = draw_field(psf, 32);
    const double centre = (static_cast<double>(field.nx) - 1) / 2;
    const Options options = make_options();
    require(wfpsf_options_set_real(options.get(), WFPSF_OPTION_MOMENTS_TOLERANCE, 1e-11));
    Ellipse m = measure(field, options.get());
    EXPECT_EQ(m.status, WFPSF_OK) << wfpsf_status_name(m.status);
    m.x -= centre;
    m.y -= centre;
    const double sigma = row.number("sigma_mas");
    EXPECT_NEAR(m.sigma * sample_mas / sigma, 1, tolerances.sigma);
    EXPECT_NEAR(m.e1, row.number("e1"), tolerances.e);
    EXPECT_NEAR(m.e2, row.number("e2"), tolerances.e);
    EXPECT_NEAR(m.x * sample_mas, row.number("x0_mas"), tolerances.sigma * sigma);
    EXPECT_NEAR(m.y * sample_mas, row.number("y0_mas"), tolerances.sigma * sigma);
    EXPECT_NEAR(sum(field), row.number("flux16"), tolerances.stamp);
    EXPECT_NEAR(sum(wide), row.number("flux32"), tolerances.stamp);

    const Ellipse blurred = measure(blurred_by(field, {}), options.get());
    EXPECT_NEAR(blurred.sigma * sample_mas / row.number("sigma_ipc_mas"), 1, tolerances.sigma);
    EXPECT_NEAR(blurred.e1, row.number("e1_ipc"), tolerances.e);
    EXPECT_NEAR(blurred.e2, row.number("e2_ipc"), tolerances.e);
    expect_sensitivity(field, row, "alpha", &Ipc::alpha, tolerances.sensitivity);
    expect_sensitivity(field, row, "alphap", &Ipc::alpha_prime, tolerances.sensitivity);
    expect_sensitivity(field, row, "plus", &Ipc::alpha_plus, tolerances.sensitivity);

    expect_half_light(wide, m, row, WFPSF_SIZE_PIXEL_SUM);
    expect_half_light(wide, m, row, WFPSF_SIZE_PIXEL_INTERPOLATED);
    expect_half_light(wide, m, row, WFPSF_SIZE_BANDLIMITED);
}

} // namespace

void expect_truth(bool struts, const MakePsf &make, const Tolerances &tolerances) {
    int compared = 0;
    for (const Row &row : Table("psf_c5/psf_c5_truth.csv")) {
        if (row.integer("struts") != struts)
            continue;
        SCOPED_TRACE("SCA " + row.text("sca") + ", " + row.text("band"));
        expect_row(make(row.integer("sca"), row.number("lam_nm")), row, tolerances);
        ++compared;
    }
    EXPECT_EQ(compared, struts ? 5 : 3);
}

void expect_stamps(const MakePsf &make, double tolerance) {
    std::map<std::string, double> wavelength_nm;
    for (const Row &row : Table("psf_c5/psf_c5_truth.csv"))
        wavelength_nm[row.text("band")] = row.number("lam_nm");
    int compared = 0;
    const std::regex pattern("psf_c5_sca(..)_(....)_(.....)_(.....)\\.fits");
    for (const auto &entry : std::filesystem::directory_iterator(reference_path("psf_c5"))) {
        const std::string name = entry.path().filename();
        std::smatch part;
        if (!std::regex_match(name, part, pattern))
            continue;
        SCOPED_TRACE(name);
        const Pixels truth = read_fits("psf_c5/" + name);
        const Psf psf = make(std::stoi(part[1]), wavelength_nm.at(part[2]));
        Pixels stamp(truth.nx, truth.ny);
        require(wfpsf_psf_draw(psf.get(), 16 + std::stod(part[3]), 16 + std::stod(part[4]), 1, NULL,
                               stamp.image.get()));
        double peak = 0, worst = 0;
        for (size_t i = 0; i < truth.data.size(); ++i) {
            peak = std::max(peak, truth.data[i]);
            worst = std::max(worst, std::abs(stamp.data[i] - truth.data[i]));
        }
        EXPECT_LE(worst / peak, tolerance);
        ::testing::Test::RecordProperty(name, std::to_string(worst / peak * 1e6) + "e-6 of peak");
        ++compared;
    }
    EXPECT_EQ(compared, 4);
}
