// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/polar_grid.hpp"

#include "numerics/dispatch.hpp"
#include "optics/sum_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace wfpsf {

namespace {

// Terms of a place, or rays, by name: loops over so few of them the compiler would rather unroll.
constexpr int64_t lanes = FilterTable<float>::lanes;
template <class T> struct Vector { typedef T type [[gnu::vector_size(lanes * sizeof(T))]]; };

constexpr int64_t together = 32; // distances, or lines of an image
constexpr int64_t run = 128;     // samples of such a line that are drawn by the same filters

// Filters get longer in so many steps, for so much less light each.
constexpr double worst = 0.1, fainter = 4;

// out[ray] = a line at the ray's place, for all terms side by side.
template <int64_t vectors, class T>
WFPSF_VECTORISED void onto_rays(const T *line, double first, double step, int64_t rays,
                                const FilterTable<T> &filter, T *out) {
    using Lanes = typename Vector<T>::type;
    T w[FilterTable<T>::most_taps];
    const int64_t taps = filter.taps();
    for (int64_t ray = 0; ray < rays; ++ray) {
        const int64_t at = filter.weights(first + static_cast<double>(ray) * step, w);
        const T *const from = line + at * vectors * lanes;
        // Odd taps by themselves, so that one sum need not wait for the other.
        Lanes even[vectors] = {}, odd[vectors] = {};
        for (int64_t tap = 0; tap < taps; tap += 2)
            for (int64_t v = 0; v < vectors; ++v) {
                Lanes some, next;
                std::memcpy(&some, from + (tap * vectors + v) * lanes, sizeof(some));
                std::memcpy(&next, from + ((tap + 1) * vectors + v) * lanes, sizeof(next));
                even[v] += w[tap] * some;
                odd[v] += w[tap + 1] * next;
            }
        for (int64_t v = 0; v < vectors; ++v) {
            const Lanes sum = even[v] + odd[v];
            std::memcpy(out + (ray * vectors + v) * lanes, &sum, sizeof(sum));
        }
    }
}

// out[i] = a line across rays at evenly spaced places.
template <class T>
WFPSF_VECTORISED void across_rays(const T *line, double first, double step, int64_t count,
                                  const FilterTable<T> &filter, T *out) {
    using Lanes = typename Vector<T>::type;
    T w[FilterTable<T>::most_taps];
    const int64_t taps = filter.padded();
    for (int64_t i = 0; i < count; ++i) {
        const T *const from = line + filter.weights(first + static_cast<double>(i) * step, w);
        Lanes sums = {};
        for (int64_t tap = 0; tap < taps; tap += lanes) {
            Lanes some, weights;
            std::memcpy(&some, from + tap, sizeof(some));
            std::memcpy(&weights, w + tap, sizeof(weights));
            sums += weights * some;
        }
        T sum = 0;
        for (int64_t lane = 0; lane < lanes; ++lane)
            sum += sums[lane];
        out[i] = sum;
    }
}

// Samples of all terms side by side: out[(i * length + j) * deep + m] is that of line i at place j
// along it. Lines run across the axis along x, or along the one along y.
template <class T>
void interleave(const ScalingTerms &terms, size_t count, bool across_x, Range lines, Range along,
                int64_t deep, T *out) {
    const int64_t length = along.end - along.begin, height = lines.end - lines.begin;
    std::vector<const double *> rows(count);
    const Range ys = across_x ? along : lines;
    for (int64_t y = ys.begin; y < ys.end; ++y) {
        for (size_t m = 0; m < count; ++m)
            rows[m] = terms[m].view().row(y) + (across_x ? lines.begin : along.begin);
        T *to = out + (y - ys.begin) * (across_x ? deep : length * deep);
        const int64_t step = across_x ? length * deep : deep;
        for (int64_t x = 0; x < (across_x ? height : length); ++x, to += step)
            for (size_t m = 0; m < count; ++m)
                to[m] = static_cast<T>(rows[m][x]);
    }
}

ScalingTerms::Light light_of(const ScalingTerms &terms, const Side &side, Range lines, Range along,
                             double negligible) {
    return side.across_x ? terms.light(lines, along, negligible)
                         : terms.light(along, lines, negligible);
}

} // namespace

template <class T> PolarFilters<T>::PolarFilters(const PolarBand &band, double eps) {
    double missed = best;
    do {
        sets_.push_back({eps / missed, FilterTable<T>({band.along_axes, missed}),
                         FilterTable<T>({PolarGrid::band_of_distances, missed}),
                         FilterTable<T>({PolarGrid::band_of_rays, missed})});
        missed *= fainter;
    } while (missed <= worst);
}

template <class T> auto PolarFilters<T>::for_light(double light) const -> const Set & {
    size_t i = 0;
    while (i + 1 < sets_.size() && light <= sets_[i + 1].up_to)
        ++i;
    return sets_[i];
}

const int64_t PolarGrid::padding = block;

PolarGrid::PolarGrid(const ScalingTerms &terms, const PolarBand &band, double inner, double outer,
                     double smallest_ratio, double largest_ratio, double ends, double best)
    : terms_(terms), best_(best), ends_(ends), inner_(inner), outer_(outer),
      smallest_(smallest_ratio), largest_(largest_ratio),
      start_(std::log(inner * smallest_) - ends),
      length_(std::log(outer * largest_) + ends - start_) {
    const double farthest = std::exp(start_ + length_);
    highest_ = band.along_rays * farthest;
    // As dense as they must be, or denser so that batches of them are full.
    const auto beyond = static_cast<double>(longest(band_of_rays));
    const double densest = band.along_axes * farthest / band_of_rays;
    rays_ = static_cast<int64_t>(std::ceil(2 * (densest + beyond))) + 1;
    rays_ = (rays_ + batch - 1) / batch * batch;
    middle_ray_ = static_cast<double>(rays_ - 1) / 2;
    step_ = 1 / (middle_ray_ - beyond);
}

template <class T>
void PolarGrid::sample(const Side &side, Range rays, int64_t samples, double negligible,
                       const PolarFilters<T> &filters, Sampled<T> &out) const {
    const double low = slope(rays.begin), high = slope(rays.end - 1);
    const auto among = [this](double from, double to) {
        return Range{std::max<int64_t>(static_cast<int64_t>(terms_.middle() + from), 0),
                     std::min(static_cast<int64_t>(terms_.middle() + to) + 2, terms_.size())};
    };
    std::vector<const FilterTable<T> *> chosen;
    out.terms = 1;
    for (int64_t i = 0; i < samples; i += together) {
        const auto distance = [&](int64_t j) {
            return std::exp(start_ +
                            length_ * static_cast<double>(j) / static_cast<double>(samples));
        };
        const double near = distance(i), far = distance(i + together);
        const auto [terms, most] = light_of(
            terms_, side, side.sign > 0 ? among(near, far) : among(-far, -near),
            among(std::min(near * low, far * low), std::max(near * high, far * high)), negligible);
        out.terms = std::max(out.terms, terms);
        chosen.push_back(&filters.for_light(most).terms);
    }
    const int64_t vectors = (static_cast<int64_t>(out.terms) + lanes - 1) / lanes;
    if (vectors == 1)
        sample<1, T>(side, rays, samples, chosen, out);
    else if (vectors == 2)
        sample<2, T>(side, rays, samples, chosen, out);
    else
        sample<most_terms / lanes, T>(side, rays, samples, chosen, out);
}

template <int64_t vectors, class T>
void PolarGrid::sample(const Side &side, Range rays, int64_t samples,
                       std::span<const FilterTable<T> *const> filters, Sampled<T> &out) const {
    out.deep = vectors * lanes;
    if (out.at.nx() < sector * out.deep || out.at.ny() < samples)
        out.at = Plane<T>::unset(sector * out.deep, samples);
    const double low = slope(rays.begin), high = slope(rays.end - 1), middle = terms_.middle();
    std::vector<T> terms, line;
    T w[FilterTable<T>::most_taps];
    for (int64_t begin = 0; begin < samples; begin += together) {
        const int64_t end = std::min(begin + together, samples);
        const FilterTable<T> &filter = *filters[static_cast<size_t>(begin / together)];
        const auto distance = [&](int64_t i) {
            return std::exp(start_ +
                            length_ * static_cast<double>(i) / static_cast<double>(samples));
        };
        const auto around = [&](double from, double to) {
            const auto first = [&](double at) {
                return static_cast<int64_t>(std::floor(middle + at)) - filter.half_width() + 1;
            };
            return Range{first(from), first(to) + filter.taps()};
        };
        const double near = distance(begin), far = distance(end - 1);
        const Range lines = side.sign > 0 ? around(near, far) : around(-far, -near);
        const Range along =
            around(std::min(near * low, far * low), std::max(near * high, far * high));
        const int64_t length = (along.end - along.begin) * out.deep;
        terms.assign(static_cast<size_t>((lines.end - lines.begin) * length + block), 0);
        interleave(terms_, out.terms, side.across_x, lines, along, out.deep, terms.data());
        line.resize(static_cast<size_t>(blocks_for(length)));
        for (int64_t i = begin; i < end; ++i) {
            const double here = distance(i);
            const int64_t first =
                filter.weights(middle + static_cast<double>(side.sign) * here, w) - lines.begin;
            const T *const start = &terms[static_cast<size_t>(first * length)];
            sum_blocks(w, filter.taps(), &start, 1, length, blocks_for(length), line.data());
            onto_rays<vectors, T>(
                line.data(), middle + here * low - static_cast<double>(along.begin), here * step_,
                rays.end - rays.begin, filter, out.at.view().row(i));
        }
    }
}

double PolarGrid::place(double in_image, int64_t per_ray) const {
    return (std::log(in_image * largest_) - start_) / length_ * static_cast<double>(per_ray);
}

Range PolarGrid::drawn_from(int64_t per_ray) const {
    const int64_t around = longest(band_of_distances);
    return {std::max<int64_t>(static_cast<int64_t>(place(inner_, per_ray)) - around + 1, 0),
            std::min(static_cast<int64_t>(place(outer_, per_ray)) + around + 1, per_ray)};
}

template <class T>
void PolarGrid::draw(const Side &side, const Plane<T> &on_rays, int64_t per_ray,
                     const PolarFilters<T> &filters, Plane<double> &image) const {
    const double middle = static_cast<double>(image.nx() - 1) / 2;
    // Where the terms of all colours lie that make up these places.
    const auto among = [this](double from, double to) {
        return Range{
            static_cast<int64_t>(terms_.middle() + std::min(from * largest_, from * smallest_)),
            static_cast<int64_t>(terms_.middle() + std::max(to * largest_, to * smallest_)) + 2};
    };
    const int64_t first_sample = drawn_from(per_ray).begin;
    std::vector<T> line(static_cast<size_t>(blocks_for(rays_ + block))), drawn(run);
    T w[FilterTable<T>::most_taps];
    const auto first = static_cast<int64_t>(middle + inner_) + 1;
    const auto last = static_cast<int64_t>(middle + outer_);
    for (int64_t begin = first; begin <= last; begin += together) {
        const int64_t end = std::min(begin + together, last + 1);
        const double near = static_cast<double>(begin) - middle,
                     far = static_cast<double>(end - 1) - middle;
        // A side is as long as it is far from the axis to either side of it.
        const int64_t nearest = image.nx() - end;
        for (int64_t left = nearest; left < image.nx() - nearest; left += run) {
            const int64_t right = std::min(left + run, image.nx() - nearest);
            const double most =
                light_of(terms_, side, side.sign > 0 ? among(near, far) : among(-far, -near),
                         among(static_cast<double>(left) - middle,
                               static_cast<double>(right - 1) - middle),
                         0)
                    .most;
            const auto &[up_to, of_terms, of_distances, of_rays] = filters.for_light(most);
            for (int64_t i = begin; i < end; ++i) {
                const int64_t x0 = std::max(left, image.nx() - 1 - i), x1 = std::min(right, i + 1);
                if (x0 >= x1)
                    continue;
                const double here = static_cast<double>(i) - middle;
                const double per_sample = 1 / (here * step_); // rays
                const auto ray = [&](int64_t x) {
                    return middle_ray_ + (static_cast<double>(x) - middle) * per_sample;
                };
                const int64_t first_ray = static_cast<int64_t>(ray(x0)) - of_rays.half_width() + 1;
                const int64_t rays =
                    static_cast<int64_t>(ray(x1 - 1)) + of_rays.half_width() + 1 - first_ray;
                const int64_t row = of_distances.weights(place(here, per_ray), w) - first_sample;
                const T *const start = on_rays.view().row(row) + first_ray;
                sum_blocks(w, of_distances.taps(), &start, 1, on_rays.nx(), blocks_for(rays),
                           line.data());
                across_rays(line.data(), ray(x0) - static_cast<double>(first_ray), per_sample,
                            x1 - x0, of_rays, drawn.data());
                const int64_t at = side.sign > 0 ? i : image.nx() - 1 - i;
                for (int64_t x = x0; x < x1; ++x)
                    (side.across_x ? image(at, x) : image(x, at)) =
                        static_cast<double>(drawn[static_cast<size_t>(x - x0)]);
            }
        }
    }
}

template class PolarFilters<float>;
template class PolarFilters<double>;
template void PolarGrid::sample(const Side &, Range, int64_t, double, const PolarFilters<float> &,
                                Sampled<float> &) const;
template void PolarGrid::sample(const Side &, Range, int64_t, double, const PolarFilters<double> &,
                                Sampled<double> &) const;
template void PolarGrid::draw(const Side &, const Plane<float> &, int64_t,
                              const PolarFilters<float> &, Plane<double> &) const;
template void PolarGrid::draw(const Side &, const Plane<double> &, int64_t,
                              const PolarFilters<double> &, Plane<double> &) const;

} // namespace wfpsf
