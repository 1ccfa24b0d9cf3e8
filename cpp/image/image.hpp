// SPDX-License-Identifier: GPL-3.0-or-later
// Pixels together with the record that travels with them: how finely they sample the native pixel,
// the native pixel's size, and which detector effects they hold already.
#pragma once

#include "image/view.hpp"

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <variant>

namespace wfpsf {

enum class PixelType { float32, float64 };

// One bit each: an image's record is their sum.
enum class Effect : uint32_t {
    none = 0,
    pixel_response = 1,
    ipc = 1 << 1,
    ipc_correction = 1 << 2,
    charge_diffusion = 1 << 3,
    background = 1 << 4,
    poisson_noise = 1 << 5,
    reciprocity_failure = 1 << 6,
    dark_current = 1 << 7,
    persistence = 1 << 8,
    nonlinearity = 1 << 9,
    nonlinearity_correction = 1 << 10,
    capacitance = 1 << 11,
    read_noise = 1 << 12,
    gain = 1 << 13,
};
inline constexpr uint32_t all_effects = (1 << 14) - 1;

const char *effect_name(Effect effect);

class Image {
  public:
    using Pixels = std::variant<View<float>, View<double>>;
    using ConstPixels = std::variant<View<const float>, View<const double>>;

    // Zeroed pixels that the image owns, contiguous. A size may be 0: the image is empty.
    Image(PixelType type, int64_t nx, int64_t ny);

    // Pixels of the caller, who keeps them alive; nothing is copied. Strides are in pixels and may
    // be negative; no two pixels may share memory.
    static Image wrap(PixelType type, void *data, int64_t nx, int64_t ny, int64_t stride_x,
                      int64_t stride_y);

    PixelType type() const;
    int64_t nx() const;
    int64_t ny() const;
    Pixels pixels() { return pixels_; }
    ConstPixels pixels() const;

    // Samples per native pixel along each axis, >= 1.
    int oversampling() const { return oversampling_; }
    void set_oversampling(int oversampling);

    // Size of the native pixel; 0 where it is not stated.
    double pixel_scale_arcsec() const { return pixel_scale_arcsec_; }
    void set_pixel_scale_arcsec(double scale);

    uint32_t applied() const { return applied_; }
    bool is_applied(Effect effect) const { return (applied_ & static_cast<uint32_t>(effect)) != 0; }
    void record_applied(Effect effect) { applied_ |= static_cast<uint32_t>(effect); }
    void set_applied(uint32_t effects) { applied_ = effects; }
    // Fails if the effect was applied before, unless force is set.
    void require_not_applied(Effect effect, bool force) const;

  private:
    struct Free {
        void operator()(void *memory) const { std::free(memory); }
    };

    explicit Image(Pixels pixels) : pixels_(pixels) {}

    std::unique_ptr<void, Free> storage_;
    Pixels pixels_;
    int oversampling_ = 1;
    double pixel_scale_arcsec_ = 0;
    uint32_t applied_ = 0;
};

} // namespace wfpsf
