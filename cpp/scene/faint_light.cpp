// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/faint_light.hpp"

#include "image/sampling.hpp"

#include <algorithm>
#include <cmath>

namespace wfpsf {

// Cells lie all over the image and as far around it as light reaches.
FaintLight::FaintLight(const SceneImage &image)
    : image_(image), flux_(static_cast<int64_t>(image.native_x()) / cell + 2 * cells_reached + 2,
                           static_cast<int64_t>(image.native_y()) / cell + 2 * cells_reached + 2),
      density_(flux_.nx(), flux_.ny()) {}

void FaintLight::add(const PlacedSource &source) {
    const auto along = [](double at) { return std::floor((at + 0.5) / cell) + cells_reached; };
    const double x = along(source.x - image_.x0), y = along(source.y - image_.y0);
    if (x >= 0 && y >= 0 && x < static_cast<double>(flux_.nx()) &&
        y < static_cast<double>(flux_.ny()))
        flux_(static_cast<int64_t>(x), static_cast<int64_t>(y)) += source.flux;
}

void FaintLight::spread(const LightProfile &profile, double radius) {
    constexpr int64_t side = 2 * cells_reached + 1;
    // From the middle of a cell.
    Plane<double> kernel(side, side);
    const auto index = [](int64_t offset) {
        return (offset + cells_reached * cell + cell / 2) / cell;
    };
    constexpr auto pixels = static_cast<int64_t>(reach);
    for (int64_t y = -pixels; y <= pixels; ++y)
        for (int64_t x = -pixels; x <= pixels; ++x) {
            const auto off = static_cast<double>(std::max(std::abs(x), std::abs(y)));
            if (off > radius)
                kernel(index(x), index(y)) += profile.mean_at(off) / (cell * cell);
        }
    for (int64_t y = 0; y < flux_.ny(); ++y)
        for (int64_t x = 0; x < flux_.nx(); ++x) {
            const double flux = flux_(x, y);
            if (flux == 0)
                continue;
            flux_(x, y) = 0;
            const int64_t low = std::max<int64_t>(x - cells_reached, 0);
            const int64_t high = std::min(x + cells_reached, flux_.nx() - 1);
            for (int64_t j = std::max<int64_t>(y - cells_reached, 0);
                 j <= std::min(y + cells_reached, flux_.ny() - 1); ++j)
                for (int64_t i = low; i <= high; ++i)
                    density_(i, j) += flux * kernel(i - x + cells_reached, j - y + cells_reached);
        }
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
        const double at = (native + 0.5) / cell - 0.5 + cells_reached;
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
