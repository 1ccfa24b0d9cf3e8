// SPDX-License-Identifier: GPL-3.0-or-later
#include "observation/observation.hpp"

#include <cstdio>
#include <string>

namespace wfpsf {

namespace {

constexpr size_t card_length = 80;

// With as many digits as bring the same number back; a point or an exponent makes it a real one.
std::string text_of(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17G", value);
    std::string number(text);
    if (number.find_first_of(".E") == std::string::npos)
        number += ".0";
    return number;
}
std::string text_of(int64_t value) {
    return std::to_string(value);
}
std::string text_of(const std::string &value) {
    char quoted[32], padded[32];
    std::snprintf(quoted, sizeof quoted, "'%-8s'", value.c_str());
    std::snprintf(padded, sizeof padded, "%-20s", quoted);
    return padded;
}

// A card in FITS's fixed format; the comment is cut to what there is room for.
std::string card_of(const FitsKeyword &keyword) {
    const std::string value =
        std::visit([](const auto &its) { return text_of(its); }, keyword.value);
    char card[2 * card_length];
    std::snprintf(card, sizeof card, "%-8s= %20s / %s", keyword.name.c_str(), value.c_str(),
                  keyword.comment.c_str());
    std::string text(card);
    text.resize(card_length, ' ');
    return text;
}

void add_terms(std::vector<FitsKeyword> &keywords, const char *axis, const SipTerms &terms) {
    keywords.push_back({std::string(axis) + "_ORDER", int64_t{4}, "order of the distortion"});
    for (size_t i = 0; i < terms.size(); ++i) {
        const auto [p, q] = sip_powers[i];
        char key[16];
        std::snprintf(key, sizeof key, "%s_%d_%d", axis, p, q);
        keywords.push_back({key, terms[i], "pixel^(1-p-q)"});
    }
}

} // namespace

std::vector<FitsKeyword> fits_keywords(const Observation &observation, int sca) {
    const TanSip &wcs = observation.wcs(sca);
    const std::string projection = "gnomonic, with distortion";
    const std::string reference = "reference pixel, the first at 1";
    const std::string centre = "[deg] centre of the focal plane";
    std::vector<FitsKeyword> keywords = {{"WCSAXES", int64_t{2}, "number of axes"},
                                         {"CTYPE1", "RA---TAN-SIP", projection},
                                         {"CTYPE2", "DEC--TAN-SIP", projection},
                                         {"CUNIT1", "deg", ""},
                                         {"CUNIT2", "deg", ""},
                                         {"CRPIX1", WcsTables::reference_pixel + 1, reference},
                                         {"CRPIX2", WcsTables::reference_pixel + 1, reference},
                                         {"CRVAL1", wcs.reference().ra_deg, "[deg] RA there"},
                                         {"CRVAL2", wcs.reference().dec_deg, "[deg] Dec there"},
                                         {"CD1_1", wcs.cd()[0], "[deg/pixel]"},
                                         {"CD1_2", wcs.cd()[1], "[deg/pixel]"},
                                         {"CD2_1", wcs.cd()[2], "[deg/pixel]"},
                                         {"CD2_2", wcs.cd()[3], "[deg/pixel]"}};
    add_terms(keywords, "A", wcs.a());
    add_terms(keywords, "B", wcs.b());
    const std::vector<FitsKeyword> rest = {
        {"LONPOLE", 180.0, "[deg]"},
        {"RADESYS", "ICRS", ""},
        {"RA_TARG", observation.pointing().ra_deg, centre},
        {"DEC_TARG", observation.pointing().dec_deg, centre},
        {"PA_OBSY", observation.observatory_angle_deg(), "[deg] of the +Y axis"},
        {"PA_FPA", observation.fpa_angle_deg(), "[deg] of the focal plane"},
        {"ORIENTAT", observation.detector_angle_deg(sca), "[deg] of the focal plane"},
        {"SCA_NUM", int64_t{sca}, "detector"}};
    keywords.insert(keywords.end(), rest.begin(), rest.end());
    return keywords;
}

std::string fits_header(const Observation &observation, int sca) {
    std::string header;
    for (const FitsKeyword &keyword : fits_keywords(observation, sca))
        header += card_of(keyword);
    return header;
}

} // namespace wfpsf
