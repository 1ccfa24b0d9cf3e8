// SPDX-License-Identifier: GPL-3.0-or-later
// An instrument: the figures of a telescope, its bands and its detectors. Those of the known ones
// are compiled in; a Design makes others.
#pragma once

#include "instrument/band.hpp"
#include "instrument/pupil.hpp"
#include "instrument/wcs.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace wfpsf {

struct Constant {
    const char *name;
    double value;
    const char *unit;
    const char *meaning;
};

// Wavefront error at one position of a detector (SCA). The first pixel's centre is (0, 0).
struct FieldPoint {
    double x_pix, y_pix;
    // Noll j = 1, 2, ...: waves at the reference wavelength, unit rms over the full circle of the
    // instrument's diameter about the optical axis.
    std::span<const double> zernikes;
};

// How wavefront errors are interpolated between a detector's five field points.
enum class FieldRule {
    // 1, x, y, xy and x^2 + y^2 combined so that all five points are met.
    five_points,
    // Bilinear between the corners; the centre point is not used. So does GalSim 2.8.4.
    corners,
};

// Taps of a 3 x 3 kernel in out(p) = sum_d K(d) in(p - d): K(dx, dy) = taps[3 (dy + 1) + dx + 1].
using IpcTaps = std::array<double, 9>;

// Of a detector, active pixels.
struct PixelCounts {
    int64_t x, y;
};

struct Instrument {
    const char *name;
    std::span<const Constant> constants;
    std::span<const Band> bands;
    std::span<const FieldPoint> all_field_points; // by SCA, as many on each, its centre first
    std::span<const Pupil> pupils;                // by mask, then by SCA; or one that serves all
    std::optional<IpcTaps> ipc_kernel;            // the detectors' nominal one, if there is one
    PixelCounts pixels;                           // of every detector
    std::optional<WcsTables> wcs;                 // if the detectors have places on the sky

    // An unknown name of an instrument, constant or band: WFPSF_ERROR_UNKNOWN_NAME. An SCA that
    // does not exist: WFPSF_ERROR_RANGE.
    static const Instrument &get(std::string_view instrument_name);
    const Constant &constant(std::string_view constant_name) const;
    const Band &band(std::string_view band_name) const;

    int sca_count() const; // SCAs are numbered from 1
    std::span<const FieldPoint> field_points(int sca) const;
    std::span<const double> zernikes(int sca) const; // at the SCA's centre

    // Anywhere on the SCA and up to `field_margin_pix` beyond the centres of its outermost pixels,
    // for stars whose light spills in. Farther off: WFPSF_ERROR_RANGE. One field point on the SCA
    // serves all of it.
    static constexpr double field_margin_pix = 512;
    std::vector<double> zernikes(int sca, double x_pix, double y_pix,
                                 FieldRule rule = FieldRule::five_points) const;

    // With struts, as an SCA sees it through the filter of a band; and without.
    const Pupil &pupil(int sca, std::string_view band_name) const;
    AnnularPupil annular_pupil() const;

    double diameter_m() const { return constant("diameter").value; }
    double obscuration() const { return constant("obscuration").value; } // of the diameter
    double pixel_scale_arcsec() const { return constant("pixel_scale").value; }
    double reference_wavelength_nm() const { return constant("zemax_wavelength").value; }
};

// All of them.
std::span<const Instrument> instruments();

} // namespace wfpsf
