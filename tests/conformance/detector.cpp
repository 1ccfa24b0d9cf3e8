// SPDX-License-Identifier: GPL-3.0-or-later
// The detector's steps, one by one and in the order of each instrument, and the sky.
#include "csv.hpp"
#include "handles.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

namespace {

using Chain = Handle<wfpsf_chain, wfpsf_chain_destroy>;

Chain make_chain() {
    wfpsf_chain *chain = nullptr;
    require(wfpsf_chain_create(&chain));
    return Chain(chain);
}

Chain single_step(int32_t step, const std::vector<double> &parameters) {
    Chain chain = make_chain();
    require(wfpsf_chain_add(chain.get(), step, std::ssize(parameters), parameters.data()));
    return chain;
}

Instrument instrument(const std::string &name) {
    wfpsf_instrument *handle = nullptr;
    require(wfpsf_instrument_create(name.c_str(), &handle));
    return Instrument(handle);
}

double constant(const Instrument &from, const char *name) {
    double value = 0;
    require(wfpsf_instrument_constant(from.get(), name, &value, nullptr));
    return value;
}

double applied(const Chain &chain, double pixel) {
    Pixels image(1, 1);
    image(0, 0) = pixel;
    require(
        wfpsf_chain_apply(chain.get(), image.image.get(), 0, nullptr, nullptr, nullptr, nullptr));
    return image(0, 0);
}

void expect_relative(double got, double wanted, double tolerance) {
    EXPECT_NEAR(got, wanted, tolerance * std::abs(wanted));
}

const char *const c5 = "wfirst-afta-c5", *const c9 = "roman-c9";

TEST(Detector, Nonlinearity) {
    const double c5_beta = constant(instrument(c5), "nonlinearity_beta");
    const double c9_beta = constant(instrument(c9), "nonlinearity_beta");
    const Chain c5_chain = single_step(WFPSF_STEP_NONLINEARITY, {c5_beta});
    const Chain c9_chain = single_step(WFPSF_STEP_NONLINEARITY, {c9_beta});
    const Chain c9_back = single_step(WFPSF_STEP_NONLINEARITY_INVERSE, {c9_beta});
    for (const Row &row : Table("nonlinearity.csv")) {
        const double in = row.number("in");
        expect_relative(applied(c5_chain, in), row.number("out_c5"), 1e-13);
        expect_relative(applied(c9_chain, in), row.number("out_c9"), 1e-13);
        if (in < -0.5 / c9_beta)
            expect_relative(applied(c9_back, row.number("out_c9")), in, 1e-13);
    }
}

TEST(Detector, Reciprocity) {
    for (const Row &row : Table("reciprocity.csv")) {
        const Chain chain =
            single_step(WFPSF_STEP_RECIPROCITY_FAILURE,
                        {row.number("alpha"), row.number("exptime_s"), row.number("base_flux")});
        expect_relative(applied(chain, row.number("in")), row.number("out"), 1e-13);
    }
}

TEST(Detector, Quantisation) {
    const Chain chain = single_step(WFPSF_STEP_QUANTISATION, {1});
    for (const Row &row : Table("quantize.csv"))
        EXPECT_EQ(applied(chain, row.number("in")), row.number("out"));
}

std::vector<double> persistence(const std::string &model) {
    std::vector<double> parameters;
    for (const Row &row : Table("instrument/persistence_c9.csv"))
        if (row.text("model") == model)
            parameters.push_back(row.number("value"));
    return parameters;
}

double with_previous(const Chain &chain, const Row &row, int count) {
    Pixels image(1, 1);
    image(0, 0) = row.number("current");
    std::vector<Pixels> previous;
    std::vector<const wfpsf_image *> handles;
    for (int k = 1; k <= count; ++k) {
        previous.emplace_back(1, 1);
        previous.back()(0, 0) = row.number("prev" + std::to_string(k));
    }
    for (const Pixels &pixels : previous)
        handles.push_back(pixels.image.get());
    require(wfpsf_chain_apply(chain.get(), image.image.get(), count, handles.data(), nullptr,
                              nullptr, nullptr));
    return image(0, 0);
}

TEST(Detector, Persistence) {
    std::vector<double> fermi_parameters = persistence("fermi");
    fermi_parameters.push_back(139.8);
    const Chain linear = single_step(WFPSF_STEP_PERSISTENCE_LINEAR, persistence("linear"));
    const Chain fermi = single_step(WFPSF_STEP_PERSISTENCE_FERMI, fermi_parameters);
    for (const Row &row : Table("persistence.csv")) {
        EXPECT_NEAR(with_previous(linear, row, 10), row.number("out_linear"), 1e-9);
        EXPECT_NEAR(with_previous(fermi, row, 3), row.number("out_fermi3"), 1e-9);
        EXPECT_NEAR(with_previous(fermi, row, 10), row.number("out_fermi_all"), 1e-9);
    }
}

// One exposure time of 2 t leaves its current at the time t.
TEST(Detector, PersistenceFermi) {
    for (const Row &row : Table("persistence_fermi.csv")) {
        std::vector<double> parameters = persistence("fermi");
        const double time = 2 * row.number("t_s");
        parameters.push_back(time);
        const Chain chain = single_step(WFPSF_STEP_PERSISTENCE_FERMI, parameters);
        Pixels image(1, 1), previous(1, 1);
        previous(0, 0) = row.number("x_e");
        const wfpsf_image *handle = previous.image.get();
        require(wfpsf_chain_apply(chain.get(), image.image.get(), 1, &handle, nullptr, nullptr,
                                  nullptr));
        expect_relative(image(0, 0) / time, row.number("rate_e_per_s"), 1e-13);
    }
}

// The whole default chains without their random parts, and the image after each of their steps.
void compare_chains(const std::string &name, const std::vector<std::string> &columns) {
    const Table table("detector_chain.csv");
    int nx = 0, ny = 0;
    for (const Row &row : table) {
        nx = std::max(nx, row.integer("ix") + 1);
        ny = std::max(ny, row.integer("iy") + 1);
    }
    Pixels signal(nx, ny), first(nx, ny), second(nx, ny);
    for (const Row &row : table) {
        signal(row.integer("ix"), row.integer("iy")) = row.number("signal");
        first(row.integer("ix"), row.integer("iy")) = row.number("prev1");
        second(row.integer("ix"), row.integer("iy")) = row.number("prev2");
    }
    const wfpsf_image *previous[] = {first.image.get(), second.image.get()};
    const Options options = make_options();
    require(wfpsf_options_set_integer(options.get(), WFPSF_OPTION_NOISE, 0));

    wfpsf_chain *whole = nullptr;
    wfpsf_ipc_kernel *kernel = nullptr;
    const Instrument telescope = instrument(name);
    require(wfpsf_chain_create_default(telescope.get(), NAN, &whole));
    const Chain owner(whole);
    require(wfpsf_ipc_kernel_create_default(telescope.get(), &kernel));
    const Kernel kernel_owner(kernel);

    Pixels by_steps(nx, ny), at_once(nx, ny);
    by_steps.data = at_once.data = signal.data;
    size_t compared = 0;
    int32_t step = 0;
    for (int64_t i = 0;; ++i) {
        std::vector<double> parameters(8);
        int64_t count = 0;
        require(wfpsf_chain_step(whole, i, 8, parameters.data(), &count, &step));
        if (step == 0)
            break;
        const Chain one = make_chain();
        if (step == WFPSF_STEP_IPC)
            require(wfpsf_chain_add_ipc(one.get(), kernel, WFPSF_EDGE_ZERO));
        else
            require(wfpsf_chain_add(one.get(), step, count, parameters.data()));
        require(wfpsf_chain_apply(one.get(), by_steps.image.get(), 2, previous, options.get(),
                                  nullptr, nullptr));
        if (step == WFPSF_STEP_POISSON_NOISE || step == WFPSF_STEP_READ_NOISE ||
            step == WFPSF_STEP_CLIP_NEGATIVE || step == WFPSF_STEP_GAIN)
            continue; // no column: they do nothing here
        const std::string &column = columns.at(compared++);
        for (const Row &row : table) {
            const double wanted = row.number(column);
            const double got = by_steps(row.integer("ix"), row.integer("iy"));
            if (step == WFPSF_STEP_QUANTISATION)
                EXPECT_EQ(got, wanted) << column;
            else
                EXPECT_NEAR(got, wanted, std::max(1e-13 * std::abs(wanted), 1e-9)) << column;
        }
    }
    EXPECT_EQ(compared, columns.size());
    require(wfpsf_chain_apply(whole, at_once.image.get(), 2, previous, options.get(), nullptr,
                              nullptr));
    for (const Row &row : table)
        EXPECT_EQ(at_once(row.integer("ix"), row.integer("iy")), row.number(columns.back()));
}

TEST(Detector, ChainOfC5) {
    compare_chains(c5, {"c5_recip", "c5_round", "c5_dark", "c5_nonlin", "c5_ipc", "c5_out"});
}

TEST(Detector, ChainOfC9) {
    compare_chains(
        c9, {"c9_round", "c9_recip", "c9_dark", "c9_persist", "c9_nonlin", "c9_ipc", "c9_out"});
}

TEST(Sky, Levels) {
    for (const Row &row : Table("sky_level.csv")) {
        const Instrument telescope = instrument(row.text("config"));
        const double longitude = row.number("ecl_lon"), latitude = row.number("ecl_lat");
        const std::string &band = row.text("band");
        double level = 0;
        const wfpsf_status status =
            wfpsf_sky_level(telescope.get(), band.c_str(), longitude, latitude, &level);
        EXPECT_EQ(status, row.integer("status") == 1 ? WFPSF_ERROR_SKY_SUN : WFPSF_OK);
        if (status == WFPSF_OK)
            expect_relative(level * row.number("exptime_s"), row.number("e_per_arcsec2"), 1e-10);
    }
}

TEST(Sky, TablesAndThermalBackground) {
    for (const char *name : {c5, c9}) {
        const Instrument telescope = instrument(name);
        const std::string file = name == c5 ? "instrument/sky_c5.csv" : "instrument/sky_c9.csv";
        const double area = name == c5 ? M_PI / 4 * 2.36 * 2.36 * (1 - 0.3 * 0.3) : 1;
        int node = 0;
        for (const Row &row : Table(file)) {
            const double latitude = std::asin(node % 42 / 41.0) * 180 / M_PI;
            const double longitude = node / 42 * 4;
            ++node;
            for (const char *band : {"Z087", "J129", "F184"})
                if (row.number(band) > 0) {
                    double level = 0;
                    // The sine of the latitude is rounded: a neighbour may come in by 1e-14.
                    if (wfpsf_sky_level(telescope.get(), band, longitude, latitude, &level) ==
                        WFPSF_OK)
                        expect_relative(level, row.number(band) * area, 1e-8);
                }
        }
        EXPECT_EQ(node, 46 * 42);
    }
    for (const Row &row : Table("instrument/thermal_backgrounds.csv")) {
        const Instrument telescope = instrument(row.text("config"));
        double electrons = 0;
        const wfpsf_status status = wfpsf_sky_background(telescope.get(), row.text("band").c_str(),
                                                         90, 30, 10, 0, &electrons);
        if (status == WFPSF_OK) { // gratings and prism have no table of the sky
            EXPECT_NEAR(electrons, 10 * row.number("thermal_e_per_pix_per_s"), 1e-14);
        }
    }
}

} // namespace
