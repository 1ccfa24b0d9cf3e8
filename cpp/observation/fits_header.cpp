// SPDX-License-Identifier: GPL-3.0-or-later
#include "observation/observation.hpp"

#include <cstdio>
#include <string>

namespace wfpsf {

namespace {

constexpr size_t card_length = 80;

// A card in FITS's fixed format; the comment is cut to what there is room for.
void add(std::string &header, const std::string &key, const char *value, const char *comment) {
    char card[2 * card_length];
    std::snprintf(card, sizeof card, "%-8s= %20s / %s", key.c_str(), value, comment);
    std::string text(card);
    text.resize(card_length, ' ');
    header += text;
}

void add_text(std::string &header, const char *key, const char *value, const char *comment) {
    char quoted[32];
    std::snprintf(quoted, sizeof quoted, "'%-8s'", value);
    char padded[32];
    std::snprintf(padded, sizeof padded, "%-20s", quoted);
    add(header, key, padded, comment);
}

void add_integer(std::string &header, const char *key, int value, const char *comment) {
    add(header, key, std::to_string(value).c_str(), comment);
}

// With as many digits as bring the same number back; a point or an exponent makes it a real one.
void add_real(std::string &header, const std::string &key, double value, const char *comment) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17G", value);
    std::string number(text);
    if (number.find_first_of(".E") == std::string::npos)
        number += ".0";
    add(header, key, number.c_str(), comment);
}

void add_terms(std::string &header, const char *axis, const SipTerms &terms) {
    add_integer(header, (std::string(axis) + "_ORDER").c_str(), 4, "order of the distortion");
    for (size_t i = 0; i < terms.size(); ++i) {
        const auto [p, q] = sip_powers[i];
        char key[16];
        std::snprintf(key, sizeof key, "%s_%d_%d", axis, p, q);
        add_real(header, key, terms[i], "pixel^(1-p-q)");
    }
}

} // namespace

std::string fits_header(const Observation &observation, int sca) {
    const TanSip &wcs = observation.wcs(sca);
    std::string header;
    add_integer(header, "WCSAXES", 2, "number of axes");
    add_text(header, "CTYPE1", "RA---TAN-SIP", "gnomonic, with distortion");
    add_text(header, "CTYPE2", "DEC--TAN-SIP", "gnomonic, with distortion");
    add_text(header, "CUNIT1", "deg", "");
    add_text(header, "CUNIT2", "deg", "");
    add_real(header, "CRPIX1", WcsTables::reference_pixel + 1, "reference pixel, the first at 1");
    add_real(header, "CRPIX2", WcsTables::reference_pixel + 1, "reference pixel, the first at 1");
    add_real(header, "CRVAL1", wcs.reference().ra_deg, "[deg] RA there");
    add_real(header, "CRVAL2", wcs.reference().dec_deg, "[deg] Dec there");
    add_real(header, "CD1_1", wcs.cd()[0], "[deg/pixel]");
    add_real(header, "CD1_2", wcs.cd()[1], "[deg/pixel]");
    add_real(header, "CD2_1", wcs.cd()[2], "[deg/pixel]");
    add_real(header, "CD2_2", wcs.cd()[3], "[deg/pixel]");
    add_terms(header, "A", wcs.a());
    add_terms(header, "B", wcs.b());
    add_real(header, "LONPOLE", 180, "[deg]");
    add_text(header, "RADESYS", "ICRS", "");
    add_real(header, "RA_TARG", observation.pointing().ra_deg, "[deg] centre of the focal plane");
    add_real(header, "DEC_TARG", observation.pointing().dec_deg, "[deg] centre of the focal plane");
    add_real(header, "PA_OBSY", observation.observatory_angle_deg(), "[deg] of the +Y axis");
    add_real(header, "PA_FPA", observation.fpa_angle_deg(), "[deg] of the focal plane");
    add_real(header, "ORIENTAT", observation.detector_angle_deg(sca), "[deg] of the focal plane");
    add_integer(header, "SCA_NUM", sca, "detector");
    return header;
}

} // namespace wfpsf
