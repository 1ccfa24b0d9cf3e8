// SPDX-License-Identifier: GPL-3.0-or-later
// Sources as a caller lists them: stars and small galaxies, each with a place, a brightness and a
// colour.
#pragma once

#include "observation/observation.hpp"
#include "optics/spectrum.hpp"
#include "scene/fingerprint.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace wfpsf {

enum class PositionKind : int32_t { detector = 1, sky = 2 }; // pixels, or degrees of RA and Dec
enum class BrightnessKind : int32_t {
    electrons = 1,
    ab_magnitude = 2
}; // in the exposure; in the band

// Sources that share a spectrum: one wavelength, 0 for the band's effective one, or an SED.
struct SourceColour {
    double wavelength_nm = 0;
    std::optional<Sed> sed = {};
};

// A Sersic profile sheared without change of area: half its light falls within half_light_radius
// before the shear. e1, e2 are (a - b) / (a + b) times cos and sin of twice the angle from x to y.
struct GalaxyShape {
    double sersic_index, half_light_radius_arcsec, e1, e2;
};

// What a detector gets of a source.
struct PlacedSource {
    double x, y;    // pixels of the detector, the first one's centre at (0, 0)
    double flux;    // e-, all of it
    int32_t colour; // of the catalogue
    int32_t shape;  // of the catalogue; star: none
    int64_t index;  // in the catalogue
    static constexpr int32_t star = -1;
};

class Catalogue {
  public:
    Catalogue(PositionKind positions, BrightnessKind brightness)
        : positions_(positions), brightness_(brightness) {}

    // Their numbers are 0, 1, ... Without any, all sources are of one colour: the band's effective
    // wavelength.
    int32_t add_colour(SourceColour colour);

    // Arrays of one length. Numbers that are not finite: WFPSF_ERROR_NOT_FINITE; a colour that is
    // not there, |Dec| > 90 or a shape out of range: WFPSF_ERROR_RANGE. Nothing is then added.
    // `colour` may be empty: colour 0.
    struct Columns {
        std::span<const double> x, y, brightness;
        std::span<const int32_t> colour;
    };
    void add_stars(const Columns &stars);
    void add_galaxies(const Columns &galaxies, std::span<const GalaxyShape> shapes);

    size_t size() const { return x_.size(); }
    PositionKind positions() const { return positions_; }
    BrightnessKind brightness() const { return brightness_; }
    std::span<const SourceColour> colours() const { return colours_; }
    std::span<const GalaxyShape> shapes() const { return shapes_; }

    // All of them on a detector, in the catalogue's order; those that have no place on it, even far
    // off, are left out. `zero_flux` is what an exposure detects of a source of magnitude 0.
    std::vector<PlacedSource> placed(const Observation *observation, int sca,
                                     double zero_flux) const;

    void add_to(Fingerprint &print) const;

  private:
    void check(const Columns &columns) const;
    void append(const Columns &columns);

    PositionKind positions_;
    BrightnessKind brightness_;
    std::vector<SourceColour> colours_;
    std::vector<GalaxyShape> shapes_;
    std::vector<double> x_, y_, bright_;
    std::vector<int32_t> colour_, shape_;
};

// Electrons a second that a source of AB magnitude 0 gives in a band: 3631 Jy through the
// collecting area and the throughput. An instrument without "collecting_area": WFPSF_ERROR_UNKNOWN_NAME.
double ab_zero_rate(const Instrument &instrument, std::string_view band);

} // namespace wfpsf
