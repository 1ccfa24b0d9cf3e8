// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/polar_sums.hpp"

#include "numerics/dispatch.hpp"
#include "numerics/fft.hpp"
#include "numerics/phasor.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;
using Complex = std::complex<double>;
constexpr int64_t batch = PolarGrid::batch;

// Frequencies that are of no use fade out over so large a part of the highest one; at least so many
// are kept.
constexpr double fading = 0.5, fewest_kept = 0.35;

// Shares of eps: what each of four filters misses of the light around them, of which any may err by
// more at one place than by all frequencies' light; and frequencies left out. The rest are digits.
constexpr double share_of_filter = 0.125, safety = 2, share_left_out = 0.35;

// From one ring to the next; and how thin the last one may be.
constexpr double octave = 0.5, thinnest = 0.8;

// How much farther than the image filters along rays reach, in periods of the highest frequency, if
// the longest miss `best`.
double ends(double best) {
    constexpr double band = PolarGrid::band_of_distances, middling = 0.25;
    const BandlimitedInterpolator distances(band, best), fade(middling, best);
    return (fade.half_width() * (1 - 2 * middling) + 1) / fading +
           distances.half_width() * band / fewest_kept;
}

// How far from the axis terms must reach for rays that are drawn from up to `half` samples off it.
int64_t reach_for(const PolarBand &band, double half, double best) {
    const auto longest = [best](double bandwidth) {
        return BandlimitedInterpolator(bandwidth, best).half_width();
    };
    const double farthest = half * std::exp(ends(best) / (band.along_rays * half));
    const double beyond =
        longest(PolarGrid::band_of_rays) * PolarGrid::band_of_rays / band.along_axes;
    return static_cast<int64_t>(std::ceil(farthest + beyond)) + longest(band.along_axes) + 1;
}

// exp(2 pi i f turns) at frequencies f = 0, 1, ..., and so many times it.
WFPSF_VECTORISED void make_waves(double turns, std::vector<double> &re, std::vector<double> &im) {
    for (size_t f = 0; f < re.size(); ++f)
        phasor(turns * static_cast<double>(f), re[f], im[f]);
}
WFPSF_VECTORISED void add_waves(double times, const std::vector<double> &re,
                                const std::vector<double> &im, std::vector<Complex> &sums) {
    for (size_t f = 0; f < re.size(); ++f)
        sums[f] += Complex(times * re[f], times * im[f]);
}

// The transform of an interpolator's kernel at a frequency in cycles a sample: one in its band, and
// zero in the band's images.
double passed(const BandlimitedInterpolator &interpolator, double frequency) {
    double sum = 0.5;
    for (int i = 1; i < 2 * interpolator.half_width(); ++i)
        sum += interpolator.kernel(i / 2.0) * std::cos(pi * frequency * i);
    return sum;
}

// Terms of a batch of rays, `deep` numbers each, become complex numbers of two.
template <class T>
WFPSF_VECTORISED void pack(const T *terms, int64_t deep, int64_t pairs, Complex *out) {
    for (int64_t r = 0; r < batch; ++r, terms += deep)
        for (int64_t p = 0; p < pairs; ++p)
            *out++ = {terms[2 * p], terms[2 * p + 1]};
}

// What a frequency of such a number is multiplied by, and the conjugate of minus that frequency.
struct Factors {
    Complex same, mirrored;
};

// The products summed over the terms, for a batch of rays.
WFPSF_VECTORISED void multiply(const Factors *factors, const Complex *same, const Complex *mirrored,
                               int64_t pairs, Complex *products) {
    for (int64_t r = 0; r < batch; ++r, same += pairs, mirrored += pairs) {
        double re = 0, im = 0;
        for (int64_t p = 0; p < pairs; ++p) {
            const auto &[a, b] = factors[p];
            re += a.real() * same[p].real() - a.imag() * same[p].imag() +
                  b.real() * mirrored[p].real() + b.imag() * mirrored[p].imag();
            im += a.real() * same[p].imag() + a.imag() * same[p].real() +
                  b.imag() * mirrored[p].real() - b.real() * mirrored[p].imag();
        }
        products[r] = {re, im};
    }
}

} // namespace

// The places between two squares.
template <class T> class PolarSums::Ring {
  public:
    Ring(const PolarSums &of, const PolarFilters<T> &filters, std::span<const ScaledColour> colours,
         const PolarGrid &grid);
    void set(std::span<Plane<double>> sums, const Progress &progress);

  private:
    std::vector<std::vector<Complex>> transfer(std::span<const ScaledColour> colours,
                                               size_t sum) const;
    double highest_bright(const std::vector<std::vector<Complex>> &transfer, double weight) const;
    void transform(Range rays);

    const PolarSums &of_;
    const PolarFilters<T> &filters_;
    const PolarGrid &grid_;
    int64_t pairs_;                               // of terms
    int64_t samples_ = 0, kept_ = 0, needed_ = 0; // of a ray, and of the sums on it; frequencies
    std::vector<std::vector<Factors>> factors_;   // [sum][frequency * pairs_ + pair]
    PolarGrid::Sampled<T> sampled_;
    std::vector<Plane<T>> sums_; // (ray, distance)
    std::vector<Complex> in_, out_;
};

// What each term's frequencies 0, 1, ... are multiplied by in one sum, in periods of a ray.
template <class T>
std::vector<std::vector<Complex>>
PolarSums::Ring<T>::transfer(std::span<const ScaledColour> colours, size_t sum) const {
    const auto frequencies =
        static_cast<size_t>((1 + fading) * grid_.highest() * grid_.length()) + 2;
    std::vector<std::vector<Complex>> transfer(of_.terms_.count(),
                                               std::vector<Complex>(frequencies));
    std::vector<double> re(frequencies), im(frequencies);
    const double largest = std::ranges::max(colours, {}, &ScaledColour::ratio).ratio;
    for (const ScaledColour &colour : colours) {
        const double weight = colour.weights[sum];
        if (weight == 0)
            continue;
        make_waves(std::log(largest / colour.ratio) / grid_.length(), re, im);
        double below = colour.x, here = 1;
        for (std::vector<Complex> &of_term : transfer) {
            add_waves(weight * here, re, im, of_term);
            below = std::exchange(here, 2 * colour.x * here - below);
        }
    }
    return transfer;
}

// The highest frequency that counts: one is found only so far from the axis that it can be as high,
// or nearer by no more than filters reach.
template <class T>
double PolarSums::Ring<T>::highest_bright(const std::vector<std::vector<Complex>> &transfer,
                                          double weight) const {
    const auto is_bright = [&](size_t f) {
        const double frequency = static_cast<double>(f) / grid_.length();
        const double from =
            std::max(std::exp(grid_.start()), frequency * std::numbers::sqrt2 /
                                                  of_.band_.along_rays * std::exp(-grid_.ends()));
        double light = 0;
        for (size_t m = 0; m < transfer.size(); ++m)
            light += std::abs(transfer[m][f]) * of_.terms_.largest_beyond(m, from);
        return light > share_left_out * of_.eps_ * weight;
    };
    auto f = static_cast<size_t>(grid_.highest() * grid_.length());
    while (f > 0 && !is_bright(f))
        --f;
    return std::min(static_cast<double>(f + 1) / grid_.length(), grid_.highest());
}

template <class T>
PolarSums::Ring<T>::Ring(const PolarSums &of, const PolarFilters<T> &filters,
                         std::span<const ScaledColour> colours, const PolarGrid &grid)
    : of_(of), filters_(filters), grid_(grid),
      pairs_(static_cast<int64_t>(of.terms_.count() + 1) / 2) {
    const double highest = grid.highest(), length = grid.length();
    double band = fewest_kept * highest;
    std::vector<std::vector<std::vector<Complex>>> transfers;
    for (size_t s = 0; s < colours[0].weights.size(); ++s) {
        double weight = 0;
        for (const ScaledColour &colour : colours)
            weight += std::abs(colour.weights[s]);
        transfers.push_back(transfer(colours, s));
        band = std::max(band, highest_bright(transfers.back(), weight));
    }
    const double fade = fading * highest;
    samples_ = good_fft_length(static_cast<int64_t>(std::ceil((highest + band + fade) * length)));
    kept_ = good_fft_length(
        static_cast<int64_t>(std::ceil(band * length / PolarGrid::band_of_distances)));
    needed_ = std::min(static_cast<int64_t>((band + fade) * length) + 1, (kept_ + 1) / 2);
    const double sharpest = 2 * band + fade; // cycles, one of which is a filter's sample
    const BandlimitedInterpolator filter(band / sharpest, PolarFilters<T>::best);
    for (const std::vector<std::vector<Complex>> &of_sum : transfers) {
        std::vector<Factors> &factors = factors_.emplace_back();
        for (int64_t f = 0; f < needed_; ++f) {
            const double factor = passed(filter, static_cast<double>(f) / (length * sharpest)) /
                                  static_cast<double>(2 * samples_);
            const auto of_term = [&](size_t m) {
                return m < of_sum.size() ? factor * of_sum[m][static_cast<size_t>(f)] : Complex(0);
            };
            const Complex i(0, 1);
            for (size_t m = 0; m < of_sum.size(); m += 2)
                factors.push_back(
                    {of_term(m) - i * of_term(m + 1), of_term(m) + i * of_term(m + 1)});
        }
    }
    const Range rows = grid.drawn_from(kept_);
    for (size_t s = 0; s < factors_.size(); ++s)
        sums_.emplace_back(grid.rays() + PolarGrid::padding, rows.end - rows.begin);
}

// Two terms at a time are one complex number, and so are two rays of a sum.
template <class T> void PolarSums::Ring<T>::transform(Range rays) {
    const auto pairs = static_cast<int64_t>((sampled_.terms + 1) / 2);
    const int64_t wide = batch * pairs, half = batch / 2;
    const int64_t narrow = half * static_cast<int64_t>(sums_.size());
    const auto at = [](std::vector<Complex> &numbers, int64_t i) { return numbers.data() + i; };
    in_.resize(static_cast<size_t>(samples_ * wide));
    out_.resize(static_cast<size_t>(kept_ * narrow));
    const BackwardFft to_frequencies(samples_, wide), from_frequencies(kept_, narrow);
    const int64_t first_row = grid_.drawn_from(kept_).begin;
    for (int64_t first = rays.begin; first < rays.end; first += batch) {
        for (int64_t i = 0; i < samples_; ++i)
            pack(sampled_.at.view().row(i) + (first - rays.begin) * sampled_.deep, sampled_.deep,
                 pairs, at(in_, i * wide));
        to_frequencies.run(in_.data());
        std::ranges::fill(out_, Complex(0));
        for (size_t s = 0; s < sums_.size(); ++s)
            for (int64_t f = 0; f < needed_; ++f) {
                Complex products[batch];
                multiply(&factors_[s][static_cast<size_t>(f * pairs_)], at(in_, f * wide),
                         at(in_, (samples_ - f) % samples_ * wide), pairs, products);
                // Sums are real: their conjugates' transform is themselves too.
                Complex *const same = at(out_, f * narrow + static_cast<int64_t>(s) * half);
                Complex *const mirrored =
                    at(out_, (kept_ - f) % kept_ * narrow + static_cast<int64_t>(s) * half);
                for (int64_t r = 0; r < half; ++r) {
                    const Complex i(0, 1), one = products[2 * r], other = products[2 * r + 1];
                    mirrored[r] = one + i * other;
                    same[r] = std::conj(one) + i * std::conj(other);
                }
            }
        from_frequencies.run(out_.data());
        for (size_t s = 0; s < sums_.size(); ++s)
            for (int64_t row = 0; row < sums_[s].ny(); ++row) {
                const Complex *const two =
                    at(out_, (first_row + row) * narrow + static_cast<int64_t>(s) * half);
                T *const sum = sums_[s].view().row(row) + first;
                for (int64_t r = 0; r < half; ++r) {
                    sum[2 * r] = static_cast<T>(two[r].real());
                    sum[2 * r + 1] = static_cast<T>(two[r].imag());
                }
            }
    }
}

template <class T>
void PolarSums::Ring<T>::set(std::span<Plane<double>> sums, const Progress &progress) {
    constexpr Side sides[] = {{false, -1}, {false, 1}, {true, -1}, {true, 1}};
    const double steps = static_cast<double>(std::size(sides) * static_cast<size_t>(grid_.rays()));
    double done = 0;
    for (const Side &side : sides) {
        for (int64_t first = 0; first < grid_.rays(); first += PolarGrid::sector) {
            progress.report(done / steps);
            const Range rays{first, std::min(first + PolarGrid::sector, grid_.rays())};
            grid_.sample(side, rays, samples_, of_.negligible_, filters_, sampled_);
            transform(rays);
            done += static_cast<double>(rays.end - rays.begin);
        }
        for (size_t s = 0; s < sums.size(); ++s)
            grid_.draw(side, sums_[s], kept_, filters_, sums[s]);
    }
}

PolarSums::PolarSums(const ScalingTerms &terms, const PolarBand &band, double eps,
                     double negligible)
    : terms_(terms), band_(band), eps_(eps), negligible_(negligible),
      single_(band, share_of_filter * eps / safety), double_(band, share_of_filter * eps / safety) {
}

// As bright as spikes are, which fall as the square of the distance.
int64_t PolarSums::reach(const PolarBand &band, double half, double range, double eps) {
    const double phase = pi * band.along_axes * octave * half * range;
    const bool is_dark =
        1 / (phase * phase) < share_of_filter * eps / (safety * PolarFilters<float>::best);
    return reach_for(band, half, is_dark ? PolarFilters<float>::best : PolarFilters<double>::best);
}

double PolarSums::dark_from(double most) const {
    const auto bright = [this, most](double distance) {
        double light = 0;
        for (size_t m = 0; m < terms_.count(); ++m)
            light += terms_.largest_beyond(m, distance);
        return light > most;
    };
    double distance = 0;
    while (distance < terms_.middle() && bright(distance))
        distance += ScalingTerms::spot;
    return distance;
}

double PolarSums::set(std::span<const ScaledColour> colours, double inner, double outer,
                      std::span<Plane<double>> sums, const Progress &progress) const {
    const auto [least, most] = std::ranges::minmax(colours, {}, &ScaledColour::ratio);
    const double smallest = least.ratio, largest = most.ratio;
    if (terms_.count() > static_cast<size_t>(PolarGrid::most_terms))
        return outer;
    const double whole = outer * outer, dark = dark_from(single_.most_light()) / smallest,
                 dim = dark_from(double_.most_light()) / smallest;
    for (double here = outer;;) {
        const auto beyond = [&](double best) {
            return ends(best) / (band_.along_rays * here * largest);
        };
        const auto next_from = [&](double light_allows, double best) {
            return std::max({inner, octave * here, light_allows * std::exp(beyond(best))});
        };
        constexpr double best[] = {PolarFilters<float>::best, PolarFilters<double>::best};
        double next = next_from(dark, best[0]);
        const bool is_dark = next <= thinnest * here;
        if (!is_dark)
            next = next_from(dim, best[1]);
        if (next > thinnest * here ||
            static_cast<double>(reach_for(band_, here * largest, best[is_dark ? 0 : 1])) >
                terms_.middle())
            return here;
        const double own = best[is_dark ? 0 : 1];
        const PolarGrid grid(terms_, band_, next, here, smallest, largest, beyond(own), own);
        const Progress part = progress.between(1 - here * here / whole, 1 - next * next / whole);
        if (is_dark)
            Ring<float>(*this, single_, colours, grid).set(sums, part);
        else
            Ring<double>(*this, double_, colours, grid).set(sums, part);
        here = next;
    }
}

} // namespace wfpsf
