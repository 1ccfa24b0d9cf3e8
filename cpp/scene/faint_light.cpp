// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/faint_light.hpp"

#include "image/sampling.hpp"

#include <algorithm>
#include <cmath>

namespace wfpsf {

namespace {

// Sums over rectangles of a plane's cells.
class Sums {
  public:
    explicit Sums(const Plane<double> &of) : sum_(of.nx() + 1, of.ny() + 1) {
        for (int64_t y = 0; y < of.ny(); ++y) {
            double row = 0;
            for (int64_t x = 0; x < of.nx(); ++x) {
                row += of(x, y);
                sum_(x + 1, y + 1) = sum_(x + 1, y) + row;
            }
        }
    }
    // Of the cells at most `reach` from (x, y) along both axes.
    double around(int64_t x, int64_t y, int64_t reach) const {
        const int64_t x0 = x - reach, x1 = x + reach + 1, y0 = y - reach, y1 = y + reach + 1;
        return sum_(x1, y1) - sum_(x0, y1) - sum_(x1, y0) + sum_(x0, y0);
    }

  private:
    Plane<double> sum_; // of all cells before
};

// Cells that get the same from a source: those at most so many off along both axes, but for those
// of the ring before.
struct Ring {
    int64_t cells;
    double density; // share of the source's light in a native pixel
};

} // namespace

// One cell beside the image on all sides takes part in the interpolation.
FaintLight::FaintLight(const SceneImage &image)
    : image_(image), density_(static_cast<int64_t>(image.native_x()) / cell + 3,
                              static_cast<int64_t>(image.native_y()) / cell + 3),
      flux_(density_.nx() + 2 * cells_reached, density_.ny() + 2 * cells_reached) {}

void FaintLight::add(const PlacedSource &source) {
    constexpr auto first = static_cast<double>(cells_reached + 1);
    const auto along = [](double at) { return std::floor((at + 0.5) / cell) + first; };
    const double x = along(source.x - image_.x0), y = along(source.y - image_.y0);
    if (x >= 0 && y >= 0 && x < static_cast<double>(flux_.nx()) &&
        y < static_cast<double>(flux_.ny()))
        flux_(static_cast<int64_t>(x), static_cast<int64_t>(y)) += source.flux;
}

// Light falls off as a power of the distance: the wider rings are, the farther off.
void FaintLight::spread(const std::function<double(double radius)> &left_out) {
    std::vector<Ring> rings;
    int64_t cells = 0;
    double beyond = left_out(0), area = 0; // of the rings before
    while (cells <= cells_reached) {
        const double radius = (static_cast<double>(cells) + 0.5) * cell;
        const double now = left_out(radius), all = 4 * radius * radius;
        rings.push_back({cells, (beyond - now) / (all - area)});
        beyond = now;
        area = all;
        cells += 1 + cells / 8;
    }
    const Sums sums(flux_);
    for (int64_t y = 0; y < density_.ny(); ++y)
        for (int64_t x = 0; x < density_.nx(); ++x) {
            double within = 0;
            for (const Ring &ring : rings) {
                const double flux = sums.around(x + cells_reached, y + cells_reached, ring.cells);
                density_(x, y) += ring.density * (flux - within);
                within = flux;
            }
        }
    flux_ = Plane<double>(flux_.nx(), flux_.ny());
}

template <class T>
void FaintLight::add_to(View<T> image, int64_t first_row, int64_t last_row) const {
    // Linear between the middles of the cells.
    struct Place {
        int64_t cell;
        double t;
    };
    const auto n = static_cast<double>(image_.oversampling);
    const auto place = [n](int64_t sample) {
        const double native = native_of(static_cast<double>(sample), n);
        const double at = (native + 0.5) / cell - 0.5 + 1;
        return Place{static_cast<int64_t>(std::floor(at)), at - std::floor(at)};
    };
    std::vector<Place> columns;
    for (int64_t x = 0; x < image.nx; ++x)
        columns.push_back(place(x));
    for (int64_t y = first_row; y <= last_row; ++y) {
        const Place row = place(y);
        const auto at = [&](int64_t i) {
            return std::lerp(density_(i, row.cell), density_(i, row.cell + 1), row.t) / (n * n);
        };
        for (int64_t x = 0; x < image.nx; ++x) {
            const Place &column = columns[static_cast<size_t>(x)];
            image(x, y) +=
                static_cast<T>(std::lerp(at(column.cell), at(column.cell + 1), column.t));
        }
    }
}

template void FaintLight::add_to(View<float>, int64_t, int64_t) const;
template void FaintLight::add_to(View<double>, int64_t, int64_t) const;

} // namespace wfpsf
