// SPDX-License-Identifier: GPL-3.0-or-later
// An instrument described by its user's figures: collected one by one, each checked as it comes,
// and made an Instrument when they are all there.
#pragma once

#include "instrument/instrument.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace wfpsf {

// All members throw Errors on figures out of range and then change nothing. Wavelengths are
// 100..100000 nm.
class Design {
  public:
    static constexpr int largest_sca_count = 1000;
    static constexpr size_t largest_strut_count = 64;

    // Diameter 0.01..100 m; linear obscuration 0..0.99 of it. Zernike coefficients are waves at the
    // reference wavelength.
    void set_telescope(double diameter_m, double obscuration, double reference_wavelength_nm);

    // A dark bar from the optical axis outwards: azimuth counterclockwise from the x axis of the
    // pupil, width 0..100 m, offset of its middle line towards larger azimuths, -100..100 m.
    void add_strut(double azimuth_deg, double width_m, double offset_m);

    // Detectors of one kind: 1..1000 of them, pixels of 1e-4..10 arcsec, 1..100000 along each axis.
    void set_detector(int sca_count, double pixel_scale_arcsec, PixelCounts pixels);

    // Aberrations of a detector: the same all over it, or at five points, the centre first, the
    // coefficients point by point. Without them a detector has none. Replaces what was set before.
    void set_zernikes(int sca, std::span<const double> coefficients);
    void set_zernikes(int sca, std::span<const double, 5> x_pix, std::span<const double, 5> y_pix,
                      std::span<const double> coefficients);

    // Throughput 0..1 at two or more wavelengths in equal steps, not all of it zero. Names are
    // unique, 1..63 bytes.
    void add_band(std::string_view name, double first_nm, double step_nm,
                  std::span<const double> throughput);

    // Telescope and detector must have been set: WFPSF_ERROR_ARGUMENT. The instrument owns copies
    // of all figures.
    std::shared_ptr<const Instrument> instrument() const;

  private:
    struct Field {
        std::vector<double> x, y; // one or five
        std::vector<double> coefficients;
        FieldPoint point(size_t i) const;
    };
    struct Curve {
        std::string name;
        double first_nm, step_nm;
        std::vector<double> throughput;
    };
    struct Built;

    void set_field(int sca, Field field);

    double diameter_m_ = 0, obscuration_ = 0, reference_wavelength_nm_ = 0;
    std::vector<Strut> struts_;
    int sca_count_ = 0;
    double pixel_scale_arcsec_ = 0;
    PixelCounts pixels_{};
    std::map<int, Field> fields_; // by SCA
    std::vector<Curve> bands_;
};

} // namespace wfpsf
