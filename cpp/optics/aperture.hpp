// SPDX-License-Identifier: GPL-3.0-or-later
// From pupil to focal plane: the diffracted amplitude
//     A(theta) = integral over the lit pupil of exp(2 pi i W(u)) exp(2 pi i u . theta / lambda) d2u
// and its intensity |A|^2 on a square grid of angles. Two ways that share no code: areal quadrature
// and a nonuniform FFT for a pupil given as geometry, a chirp transform of a mask's square pixels.
#pragma once

#include "error/progress.hpp"
#include "image/view.hpp"
#include "instrument/pupil.hpp"
#include "numerics/bandlimited.hpp"
#include "optics/pupil_raster.hpp"
#include "optics/wavefront.hpp"
#include "optics/wavefront_pairs.hpp"

#include <memory>
#include <span>
#include <vector>

namespace wfpsf {

// Angles (i - (size - 1) / 2) * step on both axes, radians.
struct FocalGrid {
    int64_t size;
    double step;
    double angle(int64_t i) const { return (static_cast<double>(i) - half()) * step; }
    double half() const { return static_cast<double>(size - 1) / 2; }
    double largest_angle() const { return half() * step; }
};

struct Diffraction {
    Plane<double> intensity; // |A|^2, (x, y), m^4
    int64_t nodes = 0;       // quadrature nodes or mask pixels summed
    // The largest error of |A|^2 in units of area^2: estimate of the numerical one, and what the
    // pupil's description may be off the truth (the fit of a geometry, the pixels of a mask).
    double error = 0, model_error = 0;
};

// The same for a grid too large to hold: |A|^2 is made a strip of rows at a time.
class DiffractionStrips {
  public:
    virtual ~DiffractionStrips() = default;

    // Rows first..first+count-1 of the grid.
    virtual Plane<double> rows(int64_t first, int64_t count) const = 0;

    int64_t nodes() const { return nodes_; }
    double error() const { return error_; } // as in Diffraction

  protected:
    int64_t nodes_ = 0;
    double error_ = 0;
};

// Bytes that strips take: always, and for each row of a strip.
struct StripMemory {
    int64_t fixed, per_row;
};

class Aperture {
  public:
    virtual ~Aperture() = default;

    // |A|^2 good to about `eps` of area^2, the peak of the unaberrated PSF.
    virtual Diffraction diffract(const Wavefront &wavefront, double wavelength,
                                 const FocalGrid &grid, double eps) const = 0;
    // The same for several wavelengths, by the factors that they are `wavelength` divided by: then
    // the grid's step is divided, too, and the wavefront's waves are multiplied.
    virtual std::vector<Diffraction> diffract_all(const Wavefront &wavefront, double wavelength,
                                                  std::span<const double> factors,
                                                  const FocalGrid &grid, double eps,
                                                  const Progress &progress) const {
        std::vector<Diffraction> all;
        for (const double factor : factors) {
            progress.report(static_cast<double>(all.size()) / static_cast<double>(factors.size()));
            all.push_back(diffract(wavefront.scaled(factor), wavelength / factor,
                                   {grid.size, grid.step / factor}, eps));
        }
        return all;
    }
    virtual std::unique_ptr<const DiffractionStrips> diffract_in_strips(const Wavefront &wavefront,
                                                                        double wavelength,
                                                                        const FocalGrid &grid,
                                                                        double eps) const = 0;
    virtual StripMemory strip_memory(double wavelength, const FocalGrid &grid,
                                     double eps) const = 0;

    // How |A|^2 answers to wavefronts that are added, exactly and for each by itself: its
    // derivative, 2 Re(A* dA), by the factor of one of `by`. Good to about eps of area^2 times the
    // largest phase of it, 2 pi |by|. A mask has none: WFPSF_ERROR_ARGUMENT.
    virtual std::vector<Plane<double>> changes(const Wavefront &wavefront,
                                               std::span<const Wavefront> by, double wavelength,
                                               const FocalGrid &grid, double eps) const = 0;

    // Of a wavefront at the lit points.
    virtual WavefrontPairs pairs(const Wavefront &wavefront) const = 0;

    // The pupil drawn on nx by ny square pixels, or a mask's own pixels, however many.
    virtual PupilRaster raster(int64_t nx, int64_t ny) const = 0;

    // What a pupil given as geometry is made of. A mask has no such parts: WFPSF_ERROR_ARGUMENT.
    virtual const std::vector<LitPart> &parts() const = 0;

    double area() const { return area_; }         // lit, m^2
    double diameter() const { return diameter_; } // the larger extent along x or y, m
    Outline outline() const { return outline_; }  // what the lit area fits in, as large

  protected:
    double area_ = 0, diameter_ = 0;
    Outline outline_ = Outline::square;
};

std::unique_ptr<const Aperture> make_aperture(const SegmentedPupil &pupil);
std::unique_ptr<const Aperture> make_aperture(const RomanPupil &pupil);
// WFPSF_ERROR_ARGUMENT if the struts leave less than a millionth of the primary lit.
std::unique_ptr<const Aperture> make_aperture(const SpiderPupil &pupil);
std::unique_ptr<const Aperture> make_aperture(const AnnularPupil &pupil);

// A mask of transmissions in [0, 1]; pixels are squares of `scale` metres, and pixel position
// (axis_x, axis_y) is the optical axis. Keeps a copy of the mask's lit part. Points at the pixels'
// centres count as much light in all, but have no raster(): WFPSF_ERROR_ARGUMENT.
enum class MaskPixels { squares, points };
std::unique_ptr<const Aperture> make_aperture(View<const double> mask, double scale, double axis_x,
                                              double axis_y,
                                              MaskPixels pixels = MaskPixels::squares);

} // namespace wfpsf
