// SPDX-License-Identifier: GPL-3.0-or-later
// wcslib, fed with the text of a FITS header: the field's own implementation of TAN-SIP.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>
#include <wcslib/wcs.h>
#include <wcslib/wcshdr.h>

namespace wfpsf {

class WcsOracle {
  public:
    explicit WcsOracle(std::string header) {
        int rejected = 0;
        if (wcspih(header.data(), static_cast<int>(header.size() / 80), 0, 0, &rejected, &count_,
                   &wcs_) != 0 ||
            count_ < 1 || wcsset(wcs_) != 0)
            throw std::runtime_error("wcslib refuses the header");
    }
    WcsOracle(const WcsOracle &) = delete;
    WcsOracle &operator=(const WcsOracle &) = delete;
    ~WcsOracle() { wcsvfree(&count_, &wcs_); }

    // Pairs of x, y and of RA, Dec; pixels count from (1, 1).
    std::vector<double> to_sky(const std::vector<double> &pixels) {
        const size_t n = pixels.size() / 2;
        std::vector<double> world(2 * n), between(2 * n), phi(n), theta(n);
        std::vector<int> status(n);
        wcsp2s(wcs_, static_cast<int>(n), 2, pixels.data(), between.data(), phi.data(),
               theta.data(), world.data(), status.data());
        return world;
    }
    std::vector<double> to_pixel(const std::vector<double> &world) {
        const size_t n = world.size() / 2;
        std::vector<double> pixels(2 * n), between(2 * n), phi(n), theta(n);
        std::vector<int> status(n);
        wcss2p(wcs_, static_cast<int>(n), 2, world.data(), phi.data(), theta.data(), between.data(),
               pixels.data(), status.data());
        return pixels;
    }

  private:
    int count_ = 0;
    wcsprm *wcs_ = nullptr;
};

} // namespace wfpsf
