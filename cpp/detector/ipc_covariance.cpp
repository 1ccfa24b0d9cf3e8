// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/ipc_covariance.hpp"

#include "detector/couplings.hpp"
#include "detector/ipc_border.hpp"
#include "error/error.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace wfpsf {

namespace {

using Place = std::pair<int64_t, int64_t>;

void require_edge(Edge edge) {
    if (edge != Edge::zero && edge != Edge::wrap)
        fail(WFPSF_ERROR_ARGUMENT, "edge = %d: must be zero or wrap, %d or %d, for a covariance",
             static_cast<int>(edge), static_cast<int>(Edge::zero), static_cast<int>(Edge::wrap));
}

// The lags along an axis, as far as taps reach, that come to the same as one: more than it alone if
// the axis is periodic and short.
std::vector<int64_t> same_lags(int64_t lag, int64_t reach, int64_t period, Edge edge) {
    std::vector<int64_t> lags;
    for (int64_t l = -2 * reach; l <= 2 * reach; ++l)
        if (edge == Edge::wrap ? floor_mod(l, period) == floor_mod(lag, period) : l == lag)
            lags.push_back(l);
    return lags;
}

template <class T> void clear_without_partner(Lag lag, int64_t samples, View<T> out) {
    const auto is_within = [&](int64_t i, int64_t shift, int64_t n) {
        return shift >= 0 ? shift <= (n - 1 - i) / samples : shift >= -(i / samples);
    };
    for (int64_t y = 0; y < out.ny; ++y)
        for (int64_t x = 0; x < out.nx; ++x)
            if (!is_within(x, lag.x, out.nx) || !is_within(y, lag.y, out.ny))
                out(x, y) = 0;
}

// cov(p, p + lag) is a convolution of the variances with K(d) K(d + lag) at d.
template <class T>
void covariance_any(const IpcKernel &kernel, View<const T> variance, Lag lag,
                    const Convolution &how, View<T> out) {
    require_edge(how.edge);
    // A periodic image comes back to a pixel after so many taps.
    const auto period = [&](int64_t size) {
        const int64_t n = std::max<int64_t>(size, 1);
        return n / std::gcd(n, std::max<int64_t>(how.tap_step, 1));
    };
    const int64_t rx = kernel.reach_x(), ry = kernel.reach_y();
    const auto lags_x = same_lags(lag.x, rx, period(variance.nx), how.edge);
    const auto lags_y = same_lags(lag.y, ry, period(variance.ny), how.edge);
    Plane<double> products(kernel.nx(), kernel.ny());
    for (int64_t dy = -ry; dy <= ry; ++dy)
        for (int64_t dx = -rx; dx <= rx; ++dx)
            for (const int64_t ly : lags_y)
                for (const int64_t lx : lags_x)
                    products(dx + rx, dy + ry) +=
                        kernel(dx, dy) * kernel.tap_or_zero(dx + lx, dy + ly);
    convolve(std::as_const(products).view(), variance, how, out);
    if (how.edge == Edge::zero)
        clear_without_partner(lag, how.tap_step, out);
}

// The same where kernels vary. Scattered, pixel q gives K_q(d) K_q(d + lag) of its variance to the
// covariance of q + d; gathered, p = q - d takes K_p(d) K_(p + lag)(d - lag) of it.
class Products {
  public:
    Products(const VaryingIpc &ipc, Lag lag, IpcForm form, Edge edge)
        : ipc_(ipc), edge_(edge), is_gathered_(form == IpcForm::gather), lag_(lag) {
        if (edge == Edge::wrap)
            lag_ = {floor_mod(lag.x, ipc.nx()), floor_mod(lag.y, ipc.ny())};
        const auto lags_x = same_lags(lag_.x, ipc.reach_x(), ipc.nx(), edge);
        const auto lags_y = same_lags(lag_.y, ipc.reach_y(), ipc.ny(), edge);
        const int64_t sign = is_gathered_ ? -1 : 1;
        std::map<Place, int64_t> index;
        for (const VaryingIpc::Offset d : ipc.offsets())
            index.emplace(Place{d.dx, d.dy}, std::ssize(index));
        for (const auto &[d, own] : index) {
            std::vector<int64_t> partners;
            for (const int64_t ly : lags_y)
                for (const int64_t lx : lags_x)
                    if (const auto other = index.find({d.first + sign * lx, d.second + sign * ly});
                        other != index.end())
                        partners.push_back(other->second);
            if (!partners.empty())
                terms_.push_back({own, std::move(partners)});
        }
        const auto count = std::ssize(ipc.offsets());
        own_ = Plane<double>(ipc.nx(), count);
        if (is_gathered_)
            others_ = Plane<double>(ipc.nx(), count);
    }

    std::vector<VaryingIpc::Offset> offsets() const {
        std::vector<VaryingIpc::Offset> offsets;
        for (const Term &term : terms_)
            offsets.push_back(ipc_.offsets()[static_cast<size_t>(term.own)]);
        return offsets;
    }

    void operator()(int64_t y, View<double> taps) {
        if (terms_.empty())
            return;
        ipc_.taps(y, own_.view());
        const int64_t y_other = is_gathered_ ? beyond(y, lag_.y, ipc_.ny()) : y;
        if (is_gathered_ && y_other >= 0)
            ipc_.taps(y_other, others_.view());
        const View<const double> own = std::as_const(own_).view();
        const View<const double> others = is_gathered_ ? std::as_const(others_).view() : own;
        for (size_t k = 0; k < terms_.size(); ++k)
            for (int64_t x = 0; x < ipc_.nx(); ++x) {
                const int64_t x_other = is_gathered_ ? beyond(x, lag_.x, ipc_.nx()) : x;
                double sum = 0;
                if (x_other >= 0 && y_other >= 0)
                    for (const int64_t partner : terms_[k].partners)
                        sum += others(x_other, partner);
                taps(x, static_cast<int64_t>(k)) = own(x, terms_[k].own) * sum;
            }
    }

  private:
    struct Term {
        int64_t own;
        std::vector<int64_t> partners;
    };

    // i + lag on an axis, -1 if that is not a pixel.
    int64_t beyond(int64_t i, int64_t lag, int64_t n) const {
        if (edge_ == Edge::wrap)
            return floor_mod(i + lag, n);
        return i + lag < n ? std::max<int64_t>(i + lag, -1) : -1;
    }

    const VaryingIpc &ipc_;
    Edge edge_;
    bool is_gathered_;
    Lag lag_;
    std::vector<Term> terms_;
    Plane<double> own_, others_; // taps of a row and of the one a lag away
};

template <class T>
void covariance_any(const VaryingIpc &ipc, View<const T> variance, Lag lag,
                    const VaryingConvolution &how, View<T> out) {
    require_edge(how.edge);
    Couplings couplings{ipc.nx(), ipc.ny(), ipc.reach_x(), ipc.reach_y(), {}, {}};
    if (ipc.nx() > 0 && ipc.ny() > 0) {
        const Products products(ipc, lag, how.form, how.edge);
        couplings.offsets = products.offsets();
        couplings.taps = products;
    }
    convolve(couplings, variance, how, out);
    if (how.edge == Edge::zero)
        clear_without_partner(lag, 1, out);
}

// The rows of A.
class Shares {
  public:
    Shares(const VaryingIpc &ipc, const VaryingConvolution &how)
        : ipc_(ipc), is_gathered_(how.form == IpcForm::gather), edge_(how.edge) {}

    std::optional<Place> pixel(int64_t x, int64_t y) const {
        const bool wraps = edge_ == Edge::wrap;
        if (!wraps && !(x >= 0 && x < ipc_.nx() && y >= 0 && y < ipc_.ny()))
            return std::nullopt;
        return Place{wraps ? floor_mod(x, ipc_.nx()) : x, wraps ? floor_mod(y, ipc_.ny()) : y};
    }

    std::map<Place, double> of(Place p) {
        std::map<Place, double> shares;
        const int64_t sign = is_gathered_ ? 1 : -1;
        for (const VaryingIpc::Offset d : ipc_.offsets())
            if (const auto q = pixel(p.first + sign * d.dx, p.second + sign * d.dy))
                shares[*q] += kernel(is_gathered_ ? p : *q).tap_or_zero(d.dx, d.dy);
        return shares;
    }

  private:
    const IpcKernel &kernel(Place p) {
        const auto found = kernels_.find(p);
        return found != kernels_.end()
                   ? found->second
                   : kernels_.emplace(p, ipc_.kernel(p.first, p.second)).first->second;
    }

    const VaryingIpc &ipc_;
    bool is_gathered_;
    Edge edge_;
    std::map<Place, IpcKernel> kernels_;
};

} // namespace

void covariance(const IpcKernel &kernel, View<const float> variance, Lag lag,
                const Convolution &how, View<float> out) {
    covariance_any(kernel, variance, lag, how, out);
}

void covariance(const IpcKernel &kernel, View<const double> variance, Lag lag,
                const Convolution &how, View<double> out) {
    covariance_any(kernel, variance, lag, how, out);
}

void covariance(const VaryingIpc &ipc, View<const float> variance, Lag lag,
                const VaryingConvolution &how, View<float> out) {
    covariance_any(ipc, variance, lag, how, out);
}

void covariance(const VaryingIpc &ipc, View<const double> variance, Lag lag,
                const VaryingConvolution &how, View<double> out) {
    covariance_any(ipc, variance, lag, how, out);
}

Plane<double> neighbour_covariances(const VaryingIpc &ipc, const Image *variance, int64_t x,
                                    int64_t y, const VaryingConvolution &how) {
    require_edge(how.edge);
    if (variance && (variance->nx() != ipc.nx() || variance->ny() != ipc.ny()))
        fail(WFPSF_ERROR_SIZE, "variance has %lld x %lld pixels: the detector has %lld x %lld",
             static_cast<long long>(variance->nx()), static_cast<long long>(variance->ny()),
             static_cast<long long>(ipc.nx()), static_cast<long long>(ipc.ny()));
    ipc.require_pixel(x, y);
    const auto variance_of = [&](Place q) -> double {
        if (!variance)
            return 1;
        return std::visit([&](auto pixels) { return double{pixels(q.first, q.second)}; },
                          variance->pixels());
    };
    Shares shares(ipc, how);
    const std::map<Place, double> own = shares.of({x, y});
    const int64_t rx = 2 * ipc.reach_x(), ry = 2 * ipc.reach_y();
    Plane<double> covariances(2 * rx + 1, 2 * ry + 1);
    for (int64_t dy = -ry; dy <= ry; ++dy)
        for (int64_t dx = -rx; dx <= rx; ++dx)
            if (const auto partner = shares.pixel(x + dx, y + dy))
                for (const auto &[q, share] : shares.of(*partner))
                    if (const auto common = own.find(q); common != own.end())
                        covariances(dx + rx, dy + ry) += share * common->second * variance_of(q);
    return covariances;
}

} // namespace wfpsf
