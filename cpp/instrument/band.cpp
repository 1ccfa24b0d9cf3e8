// SPDX-License-Identifier: GPL-3.0-or-later
#include "instrument/band.hpp"

#include "error/error.hpp"

#include <algorithm>
#include <cmath>

namespace wfpsf {
namespace {

// The largest loss of the thinning rule, as a fraction of the curve's integral: at each end, and
// between any two neighbouring samples kept.
constexpr double thinning_loss = 1e-4;

// Integral of the curve between a sample and the next.
double step_integral(const Band &band, size_t sample) {
    return band.step_nm * (band.throughput[sample] + band.throughput[sample + 1]) / 2;
}

// Integrated distance between the samples and the straight line from one of them to another.
double departure_from_line(const Band &band, size_t begin, size_t end) {
    const auto &t = band.throughput;
    const double slope = (t[end] - t[begin]) / static_cast<double>(end - begin);
    double sum = 0;
    for (size_t i = begin + 1; i < end; ++i)
        sum += std::abs(t[i] - t[begin] - slope * static_cast<double>(i - begin));
    return band.step_nm * sum;
}

} // namespace

double throughput(const Band &band, double wavelength_nm) {
    if (!std::isfinite(wavelength_nm))
        fail(WFPSF_ERROR_NOT_FINITE, "wavelength_nm = %g: must be finite", wavelength_nm);
    const size_t last = band.throughput.size() - 1;
    const double position = (wavelength_nm - band.first_nm) / band.step_nm;
    if (position < 0 || position > static_cast<double>(last))
        return 0;
    const size_t i = std::min(static_cast<size_t>(position), last - 1);
    return std::lerp(band.throughput[i], band.throughput[i + 1], position - static_cast<double>(i));
}

double integral_nm(const Band &band) {
    double sum = 0;
    for (size_t i = 0; i + 1 < band.throughput.size(); ++i)
        sum += step_integral(band, i);
    return sum;
}

BandWavelengths tabulated_wavelengths(const Band &band) {
    const auto &t = band.throughput;
    double first_moment = 0;
    for (size_t i = 0; i + 1 < t.size(); ++i)
        first_moment += band.step_nm / 6 *
                        (band.wavelength_nm(i) * (2 * t[i] + t[i + 1]) +
                         band.wavelength_nm(i + 1) * (t[i] + 2 * t[i + 1]));
    return {band.first_nm, band.wavelength_nm(t.size() - 1), first_moment / integral_nm(band)};
}

std::vector<size_t> thinned_samples(const Band &band) {
    const double limit = thinning_loss * integral_nm(band);
    size_t first = 0, last = band.throughput.size() - 1;
    double cut = step_integral(band, first);
    while (cut < limit)
        cut += step_integral(band, ++first);
    cut = step_integral(band, last - 1);
    while (cut < limit)
        cut += step_integral(band, --last - 1);

    // Greedy: a sample goes if the line from the last one kept to the next one is good enough.
    std::vector<size_t> kept{first};
    for (size_t i = first + 1; i < last; ++i)
        if (departure_from_line(band, kept.back(), i + 1) >= limit)
            kept.push_back(i);
    kept.push_back(last);
    return kept;
}

BandWavelengths thinned_wavelengths(const Band &band) {
    const std::vector<size_t> kept = thinned_samples(band);
    double flux = 0, first_moment = 0;
    for (size_t k = 0; k + 1 < kept.size(); ++k) {
        const double blue = band.wavelength_nm(kept[k]), red = band.wavelength_nm(kept[k + 1]);
        const double t_blue = band.throughput[kept[k]], t_red = band.throughput[kept[k + 1]];
        flux += (red - blue) * (t_blue + t_red) / 2;
        first_moment += (red - blue) * (blue * t_blue + red * t_red) / 2;
    }
    return {band.wavelength_nm(kept.front()), band.wavelength_nm(kept.back()), first_moment / flux};
}

} // namespace wfpsf
