// SPDX-License-Identifier: GPL-3.0-or-later
// Light of many wavelengths: what a detector counts of it, and quadrature over it.
#pragma once

#include "instrument/band.hpp"

#include <functional>
#include <span>
#include <vector>

namespace wfpsf {

// A source's relative photon flux density per unit wavelength.
struct Sed {
    std::function<double(double nm)> photons;
    // Where it is not smooth, in rising order: the samples of a table, which also bound it.
    std::vector<double> kinks_nm = {};
};

enum class SedUnit { photons, energy }; // per unit wavelength

// Linear between the samples. `density` in any unit; energies become photons by their wavelength.
Sed tabulated_sed(SedUnit unit, std::span<const double> wavelength_nm,
                  std::span<const double> density);
Sed power_law_sed(SedUnit unit, double exponent); // density proportional to wavelength^exponent
Sed black_body_sed(double temperature_k);
Sed redshifted_sed(Sed sed, double redshift);

// Detected photons by wavelength as a sum over points; the weights add up to one.
struct Spectrum {
    std::vector<double> wavelength, weight; // m
    size_t size() const { return wavelength.size(); }
    double mean_wavelength() const;
};

// What a detector sees of a source. Integrals over the spectrum are good for images that light of
// optical path differences up to `path` metres interferes in.
using Light = std::function<Spectrum(double path)>;

Light monochromatic(double wavelength);

// A source seen through a band: Gauss nodes between all kinks of both. A table that does not cover
// the band: WFPSF_ERROR_RANGE. No light at all: WFPSF_ERROR_ARGUMENT.
Light detected_light(const Band &band, const Sed &sed);

// All of several spectra, each given the same share.
Spectrum together(std::span<const Spectrum> spectra);

// The n-point Gauss rule of a spectrum (Golub & Welsch 1969, Math. Comp. 23, 221; its orthogonal
// polynomials by Stieltjes' procedure): sums of polynomials of degree below 2n in 1 / wavelength,
// in which interference is a wave, are exact, however rough the throughput. Where that asks for
// more than a third of the spectrum's own points, or another share of them, they are the rule.
class WavelengthRule {
  public:
    static constexpr double usual_share = 1.0 / 3;
    WavelengthRule(const Spectrum &spectrum, size_t n, double largest_share = usual_share);

    size_t size() const { return wavelength_.size(); }
    const std::vector<double> &wavelengths() const { return wavelength_; } // m

    bool exact() const { return exact_; } // the rule is the spectrum itself

    // The same nodes for another spectrum, whose points are among those of the rule's own: exact
    // for polynomials of degree below n, and to 2n for the rule's own.
    std::vector<double> weights(const Spectrum &spectrum) const;

  private:
    std::vector<double> moments(const Spectrum &spectrum) const;
    std::vector<double> polynomials(double wavelength) const; // orthonormal ones of degree 0..n-1
    double scaled(double wavelength) const { return (1 / wavelength - middle_) / half_; }

    double middle_, half_; // of 1 / wavelength
    bool exact_;
    std::vector<double> alpha_, beta_; // of the recurrence; beta_[k] is a root already
    std::vector<double> wavelength_, gauss_;
    std::vector<std::vector<double>> polynomial_; // by node
};

} // namespace wfpsf
