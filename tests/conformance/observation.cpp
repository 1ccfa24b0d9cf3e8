// SPDX-License-Identifier: GPL-3.0-or-later
// WCS, detectors that positions fall on, pointings and rolls: those of the peer under its own rule,
// the mission's headers, and what is right where the peer is not.
#include "csv.hpp"
#include "handles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numbers>

namespace {

using Observation = Handle<wfpsf_observation, wfpsf_observation_destroy>;

constexpr int rule_of_peer = 1;

Instrument instrument(const char *name) {
    wfpsf_instrument *handle = nullptr;
    require(wfpsf_instrument_create(name, &handle));
    return Instrument(handle);
}

Options options(bool of_fpa, int rule = rule_of_peer) {
    Options made = make_options();
    require(wfpsf_options_set_integer(made.get(), WFPSF_OPTION_WCS_RULE, rule));
    require(wfpsf_options_set_integer(made.get(), WFPSF_OPTION_PA_OF_FPA, of_fpa ? 1 : 0));
    return made;
}

Observation observe(const char *name, double ra, double dec, double pa, bool of_fpa) {
    wfpsf_observation *handle = nullptr;
    require(wfpsf_observation_create(instrument(name).get(), ra, dec, pa, options(of_fpa).get(),
                                     &handle));
    return Observation(handle);
}

double date_of(const std::string &utc) {
    int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0;
    if (std::sscanf(utc.c_str(), "%d-%d-%dT%d:%d:%d", &year, &month, &day, &hour, &minute,
                    &second) != 6)
        throw std::runtime_error(utc);
    double date = 0;
    require(wfpsf_julian_date(year, month, day, hour, minute, second, &date));
    return date;
}

// The pointings that the tables' headers describe.
const wfpsf_observation *pointing(const std::string &name) {
    static const std::map<std::string, Observation> all = [] {
        std::map<std::string, Observation> made;
        made["A"] = observe("roman-c9", 60, -30, 30, false);
        made["B"] = observe("roman-c9", 210.5, 42.3, -75.25, true);
        wfpsf_observation *c = nullptr;
        require(wfpsf_observation_create_on_date(instrument("roman-c9").get(), 53.1, -27.8,
                                                 date_of("2026-08-20T06:00:00"),
                                                 options(false).get(), &c));
        made["C"] = Observation(c);
        made["G"] = observe("wfirst-afta-c5", 52.3, -27.9, 41.5, false);
        made["H"] = observe("wfirst-afta-c5", 359.93, 12.6, 205.25, true);
        made["I"] = observe("wfirst-afta-c5", 230.75, 89.3, -130, false);
        return made;
    }();
    return all.at(name).get();
}

struct Place {
    double first, second;
};

Place sky_at(const wfpsf_observation *of, int sca, double x, double y) { // pixels from (1, 1)
    const double x0 = x - 1, y0 = y - 1;
    Place at{};
    require(wfpsf_observation_pixel_to_sky(of, sca, 1, &x0, &y0, &at.first, &at.second, nullptr));
    return at;
}

Place pixel_at(const wfpsf_observation *of, int sca, double ra, double dec) {
    Place at{};
    require(wfpsf_observation_sky_to_pixel(of, sca, 1, &ra, &dec, &at.first, &at.second, nullptr));
    return {at.first + 1, at.second + 1};
}

double apart_arcsec(const Place &a, double ra, double dec) {
    const double east = std::remainder(a.first - ra, 360) * std::cos(dec * std::numbers::pi / 180);
    return std::hypot(east, a.second - dec) * 3600;
}

// With a table's name, the tests' parameter.
class PixelsToSky : public testing::TestWithParam<const char *> {};

TEST_P(PixelsToSky, PositionsAndAreas) {
    for (const Row &row : Table(GetParam())) {
        const wfpsf_observation *of = pointing(row.text("pointing"));
        const int sca = row.integer("sca");
        const double x = row.number("x"), y = row.number("y");
        const double ra = row.number("ra_deg"), dec = row.number("dec_deg");
        EXPECT_LT(apart_arcsec(sky_at(of, sca, x, y), ra, dec), 1e-7);
        const Place back = pixel_at(of, sca, ra, dec);
        EXPECT_NEAR(back.first, x, 1e-5);
        EXPECT_NEAR(back.second, y, 1e-5);
        const double x0 = x - 1, y0 = y - 1;
        double area = 0;
        require(wfpsf_observation_jacobian(of, sca, 1, &x0, &y0, nullptr, &area, nullptr, nullptr));
        EXPECT_NEAR(area, row.number("pixel_area_arcsec2"), 1e-8 * area);
    }
}

INSTANTIATE_TEST_SUITE_P(Telescopes, PixelsToSky,
                         testing::Values("wcs_pix2sky.csv", "wcs_c5_pix2sky.csv"));

TEST(Observation, SkyToPixels) {
    for (const Row &row : Table("wcs_sky2pix.csv")) {
        const Place at = pixel_at(pointing(row.text("pointing")), row.integer("sca"),
                                  row.number("ra_deg"), row.number("dec_deg"));
        EXPECT_NEAR(at.first, row.number("x"), 1e-5);
        EXPECT_NEAR(at.second, row.number("y"), 1e-5);
    }
}

TEST(Observation, Centres) {
    for (const Row &row : Table("wcs_sca_centres.csv")) {
        const wfpsf_observation *of = pointing(row.text("pointing"));
        const int sca = row.integer("sca");
        EXPECT_LT(apart_arcsec(sky_at(of, sca, 2044, 2044), row.number("crpix_ra_deg"),
                               row.number("crpix_dec_deg")),
                  1e-7);
        EXPECT_LT(apart_arcsec(sky_at(of, sca, 2044.5, 2044.5), row.number("centre_ra_deg"),
                               row.number("centre_dec_deg")),
                  1e-7);
    }
}

const std::map<std::string, int32_t> keys = {
    {"RA_TARG", WFPSF_OBSERVATION_RA},       {"DEC_TARG", WFPSF_OBSERVATION_DEC},
    {"PA_OBSY", WFPSF_OBSERVATION_PA},       {"PA_FPA", WFPSF_OBSERVATION_PA_FPA},
    {"CRPIX1", WFPSF_OBSERVATION_CRPIX1},    {"CRPIX2", WFPSF_OBSERVATION_CRPIX2},
    {"CRVAL1", WFPSF_OBSERVATION_CRVAL1},    {"CRVAL2", WFPSF_OBSERVATION_CRVAL2},
    {"CD1_1", WFPSF_OBSERVATION_CD1_1},      {"CD1_2", WFPSF_OBSERVATION_CD1_2},
    {"CD2_1", WFPSF_OBSERVATION_CD2_1},      {"CD2_2", WFPSF_OBSERVATION_CD2_2},
    {"ORIENTAT", WFPSF_OBSERVATION_ORIENTAT}};

void expect_keyword(const wfpsf_observation *of, const Row &row, const char *column) {
    const std::string &key = row.text("key");
    if (!keys.contains(key))
        return; // LONPOLE is 180
    const int sca = row.integer("sca");
    double got = 0, dec = 0;
    require(wfpsf_observation_get(of, sca, keys.at(key), &got));
    require(wfpsf_observation_get(of, sca, WFPSF_OBSERVATION_CRVAL2, &dec));
    const double off = std::remainder(got - row.number(column), 360);
    // Near a pole, RA and angles turn fast.
    const bool turns = key == "CRVAL1" || key == "ORIENTAT";
    const double share = turns ? std::cos(dec * std::numbers::pi / 180) : 1;
    const double tolerance = key.starts_with("CD") ? 1e-9 * 3e-5 : 1e-8;
    EXPECT_LE(std::abs(off) * share, tolerance) << key << " of " << sca;
}

class Headers : public testing::TestWithParam<const char *> {};

TEST_P(Headers, Keywords) {
    for (const Row &row : Table(GetParam()))
        expect_keyword(pointing(row.text("pointing")), row, "value");
}

INSTANTIATE_TEST_SUITE_P(Telescopes, Headers,
                         testing::Values("wcs_header.csv", "wcs_c5_header.csv"));

// A header of the mission's own, applied as the linear WCS that it all but is.
Place mission_sky(const std::map<std::string, double> &header, double x, double y) {
    constexpr double degree = std::numbers::pi / 180;
    const double dx = x - header.at("CRPIX1"), dy = y - header.at("CRPIX2");
    const double xi = (header.at("CD1_1") * dx + header.at("CD1_2") * dy) * degree;
    const double eta = (header.at("CD2_1") * dx + header.at("CD2_2") * dy) * degree;
    const double dec = header.at("CRVAL2") * degree;
    const double out = std::cos(dec) - eta * std::sin(dec);
    return {header.at("CRVAL1") + std::atan2(xi, out) / degree,
            std::atan2(std::sin(dec) + eta * std::cos(dec), std::hypot(xi, out)) / degree};
}

TEST(Observation, HeadersOfTheMission) {
    std::map<std::string, std::map<std::string, double>> headers;
    std::map<std::string, int> detectors;
    const Table table("wcs_c5_mission.csv");
    for (const Row &row : table) {
        headers[row.text("pointing")][row.text("key")] = row.number("mission");
        detectors[row.text("pointing")] = row.integer("sca");
    }
    ASSERT_EQ(headers.size(), 4U);
    for (const auto &[name, header] : headers) {
        const bool of_fpa = name == "T1" || name == "T3";
        const Observation of =
            observe("wfirst-afta-c5", header.at("RA_TARG"), header.at("DEC_TARG"),
                    header.at(of_fpa ? "PA_FPA" : "PA_OBSY"), of_fpa);
        for (const double x : {1.0, 2044.0, 4088.0})
            for (const double y : {1.0, 2044.0, 4088.0}) {
                const Place theirs = mission_sky(header, x, y);
                EXPECT_LT(apart_arcsec(sky_at(of.get(), detectors[name], x, y), theirs.first,
                                       theirs.second),
                          5e-4)
                    << name;
            }
        for (const Row &row : table)
            if (row.text("pointing") == name)
                expect_keyword(of.get(), row, "peer");
    }
}

class Detectors : public testing::TestWithParam<const char *> {};

TEST_P(Detectors, ThatPositionsFallOn) {
    const bool cut = std::string(GetParam()).find("c5") != std::string::npos;
    for (const Row &row : Table(GetParam())) {
        const wfpsf_observation *of = pointing(row.text("pointing"));
        const double ra = row.number("ra_deg"), dec = row.number("dec_deg");
        std::array<int32_t, 2> sca{};
        for (int gaps : {0, 1})
            require(wfpsf_observation_find_sca(of, gaps, 1, &ra, &dec,
                                               &sca[static_cast<size_t>(gaps)], nullptr, nullptr,
                                               nullptr));
        EXPECT_EQ(sca[0], row.integer("sca"));
        EXPECT_EQ(sca[1], row.integer("sca_border"));
        int claims = 0;
        for (int i = 1; i <= 18; ++i) {
            int64_t x_first = 0, x_last = 0, y_first = 0, y_last = 0;
            require(wfpsf_observation_bounds(of, i, 1, &x_first, &x_last, &y_first, &y_last));
            const Place at = pixel_at(of, i, ra, dec);
            const double x = cut ? std::trunc(at.first) : at.first;
            const double y = cut ? std::trunc(at.second) : at.second;
            claims += x - 1 >= static_cast<double>(x_first) &&
                      x - 1 <= static_cast<double>(x_last) &&
                      y - 1 >= static_cast<double>(y_first) && y - 1 <= static_cast<double>(y_last);
        }
        EXPECT_EQ(claims, row.integer("n_border"));
        if (!row.has("x"))
            continue;
        const Place at = pixel_at(of, row.integer("ref_sca"), ra, dec);
        EXPECT_NEAR(at.first, row.number("x"), 1e-5);
        EXPECT_NEAR(at.second, row.number("y"), 1e-5);
    }
}

INSTANTIATE_TEST_SUITE_P(Telescopes, Detectors,
                         testing::Values("wcs_findsca.csv", "wcs_c5_findsca.csv"));

TEST(Observation, AimedAtAPlace) {
    const Instrument roman = instrument("roman-c9");
    for (const Row &row : Table("wcs_convert_center.csv")) {
        wfpsf_observation *made = nullptr;
        require(wfpsf_observation_create_aimed(roman.get(), row.integer("sca"), 2043, 2043,
                                               row.number("ra_deg"), row.number("dec_deg"),
                                               row.number("pa_deg"), options(false).get(), &made));
        const Observation of(made);
        Place centre{};
        require(wfpsf_observation_get(of.get(), 1, WFPSF_OBSERVATION_RA, &centre.first));
        require(wfpsf_observation_get(of.get(), 1, WFPSF_OBSERVATION_DEC, &centre.second));
        EXPECT_LT(apart_arcsec(centre, row.number("fpa_ra_deg"), row.number("fpa_dec_deg")), 0.5);
    }
}

TEST(Observation, SunAndRoll) {
    const Options peer = options(false);
    for (const char *name : {"roman-c9", "wfirst-afta-c5"}) {
        const Instrument of = instrument(name);
        for (const Row &row : Table("pointing.csv")) {
            const double date = date_of(row.text("date_utc"));
            EXPECT_NEAR(date, row.number("julian_day"), 1e-9);
            Place sun{};
            require(wfpsf_sun_position(date, peer.get(), &sun.first, &sun.second));
            EXPECT_NEAR(std::remainder(sun.first - row.number("sun_ra"), 360), 0, 1e-8);
            EXPECT_NEAR(sun.second, row.number("sun_dec"), 1e-8);
            const double ra = row.number("ra_deg"), dec = row.number("dec_deg");
            double angle = 0, pa = 0;
            int32_t allowed = -1;
            require(wfpsf_pointing_allowed(of.get(), ra, dec, date, peer.get(), &angle, &allowed));
            EXPECT_NEAR(angle, row.number("sun_angle"), 1e-8);
            EXPECT_EQ(allowed, row.integer("allowed"));
            const wfpsf_status status =
                wfpsf_pointing_best_pa(of.get(), ra, dec, date, peer.get(), &pa);
            if (allowed == 0) {
                EXPECT_EQ(status, WFPSF_ERROR_SUN_ANGLE);
                continue;
            }
            require(status);
            EXPECT_NEAR(std::remainder(pa - row.number("peer_best_pa"), 360), 0, 1e-6);
            // Undo what the peer does with the angle east of north.
            const double right = (angle < 90 ? 0 : 180) - pa;
            EXPECT_NEAR(std::remainder(right - row.number("pa_east_of_north"), 360), 0, 1e-8);
        }
    }
}

// The Sun of the ICRS against the table's: its longitude, of the equinox of date, less the
// precession since J2000, which is 50.29 arcsec a year in longitude. Low precision: 0.01 degrees.
TEST(Observation, SunOfTheIcrs) {
    for (const Row &row : Table("pointing.csv")) {
        constexpr double degree = std::numbers::pi / 180, obliquity = 23.4392911;
        const double date = date_of(row.text("date_utc"));
        const double longitude =
            (row.number("sun_lon") - 50.29 / 3600 * (date - 2451545) / 365.25) * degree;
        Place sun{};
        require(wfpsf_sun_position(date, nullptr, &sun.first, &sun.second));
        EXPECT_NEAR(sun.second,
                    std::asin(std::sin(obliquity * degree) * std::sin(longitude)) / degree, 0.015);
        const double ra =
            std::atan2(std::cos(obliquity * degree) * std::sin(longitude), std::cos(longitude));
        EXPECT_NEAR(std::remainder(sun.first - ra / degree, 360), 0, 0.02);
    }
}

} // namespace
