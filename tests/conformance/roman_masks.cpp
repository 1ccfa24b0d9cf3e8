// SPDX-License-Identifier: GPL-3.0-or-later
#include "roman_masks.hpp"

#include <cstdio>
#include <vector>

Instrument make_roman() {
    wfpsf_instrument *instrument = nullptr;
    require(wfpsf_instrument_create("roman-c9", &instrument));
    return Instrument(instrument);
}

Options peer_options() {
    Options options = make_options();
    require(wfpsf_options_set_real(options.get(), WFPSF_OPTION_EPS, 1e-10));
    require(wfpsf_options_set_real(options.get(), WFPSF_OPTION_PSF_RADIUS, 17));
    require(wfpsf_options_set_integer(options.get(), WFPSF_OPTION_FRAME, 1));
    require(wfpsf_options_set_integer(options.get(), WFPSF_OPTION_FIELD_RULE, 1));
    return options;
}

Pixels read_mask(int sca, const std::string &band) {
    char file[80];
    std::snprintf(file, sizeof file, "instrument/pupil_c9/RST_WIM_Filter_%s_SCA_%d.fits.gz",
                  band == "F184" ? "F184" : "skinny", sca);
    Pixels mask = read_fits(file);
    for (double &pixel : mask.data)
        pixel /= 255;
    return mask;
}

Psf make_masked(const Row &aberrations, const MaskPlace &place, double wavelength_nm,
                const Options &options) {
    const Instrument roman = make_roman();
    const int sca = aberrations.integer("sca");
    std::vector<double> own(22), extra(22);
    require(wfpsf_instrument_zernikes(roman.get(), sca, 22, own.data(), nullptr));
    for (size_t j = 4; j <= 22; ++j) {
        char column[8];
        std::snprintf(column, sizeof column, "z%zu", j);
        extra[j - 1] = aberrations.number(column) - own[j - 1];
    }
    require(wfpsf_options_set_zernikes(options.get(), 22, extra.data()));
    wfpsf_psf *psf = nullptr;
    require(wfpsf_psf_create_from_mask(roman.get(), place.mask.image.get(), place.scale_m,
                                       place.axis_x, place.axis_y, sca, wavelength_nm,
                                       options.get(), &psf));
    return Psf(psf);
}

Pixels draw(const Psf &psf, int side, int oversampling) {
    Pixels stamp(side, side, oversampling);
    require(wfpsf_psf_draw(psf.get(), (side - 1) / 2.0, (side - 1) / 2.0, 1, nullptr,
                           stamp.image.get()));
    return stamp;
}
