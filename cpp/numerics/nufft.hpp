// SPDX-License-Identifier: GPL-3.0-or-later
// Nonuniform fast Fourier transform of type 1 in two dimensions: scattered sources to a uniform
// grid of modes (Barnett, Magland & af Klinteberg 2019, SIAM J. Sci. Comput. 41, C479; used for
// diffraction by Barnett 2021, J. Astron. Telesc. Instrum. Syst. 7, 021211).
#pragma once

#include "image/memory.hpp"

#include <complex>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace wfpsf {

inline constexpr double nufft_best_eps = 1e-14;

// F(jx, jy) = sum_n c_n exp(i (a_n jx + b_n jy)), jx, jy = -K..K, with an error of about eps times
// sum |c_n|. Sources are added in batches; then the modes are asked for, all at once or a strip of
// rows at a time, so that the memory is that of the sources' band and of the rows.
class Type1Transform {
  public:
    // The range of a source's angle along one axis, within -pi..pi. The narrower, the faster:
    // transforms of what is known to be zero are left out.
    struct Band {
        double low, high;
    };

    // So many of them at once, of the same places and with sources of their own.
    Type1Transform(Band a, Band b, int64_t K, double eps, size_t count = 1);

    // What one transform of these arguments holds, and what rows() takes besides for each row.
    struct Memory {
        int64_t held, per_row; // bytes
    };
    static Memory memory(Band a, Band b, int64_t K, double eps);

    // Every source must lie within the bands. The sources of one transform follow another's.
    void add(std::span<const double> a, std::span<const double> b,
             std::span<const std::complex<double>> c);

    // Calls row(jy, modes -K..K along x) for jy = first..last in this order. Every call transforms
    // all of the band along y anew.
    using RowSink = std::function<void(int64_t jy, std::span<const std::complex<double>> modes)>;
    void rows(int64_t first, int64_t last, const RowSink &row, size_t which = 0) const;
    // Gives its memory back.
    void release(size_t which) { cells_[which] = {}; }

  private:
    using Cells = std::vector<std::complex<double>, AlignedAllocator<std::complex<double>>>;

    // One axis of the fine grid.
    struct Axis {
        int64_t n;           // cells in a period
        int64_t first, used; // cells that the sources may touch
        Axis(Band band, int64_t cells, int width);
    };
    Cells transform_columns(const Cells &cells, int64_t first, int64_t last) const;

    int64_t K_;
    double oversampling_; // cells of the fine grid to a mode
    int width_;           // of the spreading kernel, fine grid cells
    Axis x_, y_;
    std::vector<double> correction_; // one over the kernel's transform at modes -K..K
    int64_t stride_;                 // of a row of cells
    std::vector<Cells> cells_;       // of each transform
};

} // namespace wfpsf
