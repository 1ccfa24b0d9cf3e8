// SPDX-License-Identifier: GPL-3.0-or-later
#include "funnel.hpp"
#include "handles.hpp"
#include "optics/wavefront.hpp"

#include <cmath>

namespace {

struct Description {
    const char *name;
    int32_t key, kind;
    double standard, smallest, largest;
    const char *text;
};

constexpr Description descriptions[] = {
#define WFPSF_DESCRIPTION(name, key, kind, standard, smallest, largest, text)                      \
    {#name, key, WFPSF_OPTION_##kind, standard, smallest, largest, text},
    WFPSF_OPTION_LIST(WFPSF_DESCRIPTION)
#undef WFPSF_DESCRIPTION
};
constexpr size_t option_count = std::size(descriptions);

size_t index_of(int32_t key) {
    for (size_t i = 0; i < option_count; ++i)
        if (descriptions[i].key == key)
            return i;
    wfpsf::fail(WFPSF_ERROR_UNKNOWN_NAME, "key = %d: no option has that key", key);
}

} // namespace

struct wfpsf_options {
    std::array<double, option_count> values;
    std::vector<double> zernikes;
    std::shared_ptr<const wfpsf::OpdMap> opd_map;
    std::shared_ptr<wfpsf::SceneStore> scene_store;
    wfpsf_progress progress;
    void *progress_user;
};

namespace wfpsf {

namespace {

void set(wfpsf_options *options, int32_t key, int32_t kind, double value) {
    require_pointer(options, "options");
    const size_t i = index_of(key);
    const Description &d = descriptions[i];
    if (d.kind != kind)
        fail(WFPSF_ERROR_UNKNOWN_NAME, "key = %d: option %s takes %s", key, d.name,
             d.kind == WFPSF_OPTION_REAL ? "a real number" : "an integer");
    if (!std::isfinite(value))
        fail(WFPSF_ERROR_NOT_FINITE, "%s = %g: must be finite", d.name, value);
    if (value < d.smallest || value > d.largest)
        fail(WFPSF_ERROR_RANGE, "%s = %.17g: must be %g..%g", d.name, value, d.smallest, d.largest);
    options->values[i] = value;
}

} // namespace

double option(const wfpsf_options *options, int32_t key) {
    const size_t i = index_of(key);
    return options ? options->values[i] : descriptions[i].standard;
}

bool flag(const wfpsf_options *options, int32_t key) {
    return option(options, key) != 0;
}

std::span<const double> checked_zernikes(int64_t count, const double *coefficients,
                                         int64_t points) {
    if (count < 0 || count > Wavefront::largest_j)
        fail(WFPSF_ERROR_RANGE, "count = %lld: must be 0..%d", static_cast<long long>(count),
             Wavefront::largest_j);
    if (count > 0)
        require_pointer(coefficients, "coefficients");
    const std::span given(coefficients, static_cast<size_t>(count * points));
    for (size_t i = 0; i < given.size(); ++i)
        if (!std::isfinite(given[i]))
            fail(WFPSF_ERROR_NOT_FINITE, "coefficients[%zu] = %g: must be finite", i, given[i]);
    return given;
}

const std::vector<double> &extra_zernikes(const wfpsf_options *options) {
    static const std::vector<double> none;
    return options ? options->zernikes : none;
}

Manners manners_of(const wfpsf_options *options) {
    Manners manners;
    manners.memory_limit = static_cast<int64_t>(option(options, WFPSF_OPTION_MEMORY_LIMIT));
    manners.threads = static_cast<int>(option(options, WFPSF_OPTION_THREADS));
    if (options && options->progress)
        manners.progress.go_on = [call = options->progress, user = options->progress_user](
                                     double part) { return call(part, user) == 0; };
    return manners;
}

std::shared_ptr<const OpdMap> opd_map(const wfpsf_options *options) {
    return options ? options->opd_map : nullptr;
}

SceneReuse scene_reuse(const wfpsf_options *options) {
    if (!options || !options->scene_store)
        return {};
    return {options->scene_store, option(options, WFPSF_OPTION_SCENE_EXPOSURES)};
}

void check_pupil_sampling(const char *scale_name, double scale_m, double axis_x, double axis_y) {
    require_finite(scale_m, scale_name);
    if (!(scale_m > 0 && scale_m <= 1))
        fail(WFPSF_ERROR_RANGE, "%s = %g: must be above 0, up to 1", scale_name, scale_m);
    for (const auto &[name, value] : {std::pair("axis_x", axis_x), std::pair("axis_y", axis_y)}) {
        require_finite(value, name);
        if (!(std::abs(value) <= 1e6))
            fail(WFPSF_ERROR_RANGE, "%s = %g: must be -1e6..1e6", name, value);
    }
}

} // namespace wfpsf

using namespace wfpsf;

wfpsf_status wfpsf_options_create(wfpsf_options **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        auto *options = new wfpsf_options{};
        for (size_t i = 0; i < option_count; ++i)
            options->values[i] = descriptions[i].standard;
        *out = options;
    });
}

void wfpsf_options_destroy(wfpsf_options *options) {
    delete options;
}

wfpsf_status wfpsf_options_set_real(wfpsf_options *options, int32_t key, double value) {
    return guarded([&] { set(options, key, WFPSF_OPTION_REAL, value); });
}

wfpsf_status wfpsf_options_set_integer(wfpsf_options *options, int32_t key, int64_t value) {
    return guarded([&] { set(options, key, WFPSF_OPTION_INTEGER, static_cast<double>(value)); });
}

wfpsf_status wfpsf_options_get(const wfpsf_options *options, int32_t key, double *value) {
    return guarded([&] {
        require_pointer(options, "options");
        require_pointer(value, "value");
        *value = option(options, key);
    });
}

wfpsf_status wfpsf_options_reset(wfpsf_options *options, int32_t key) {
    return guarded([&] {
        require_pointer(options, "options");
        const size_t i = index_of(key);
        options->values[i] = descriptions[i].standard;
    });
}

wfpsf_status wfpsf_options_set_zernikes(wfpsf_options *options, int64_t count,
                                        const double *coefficients) {
    return guarded([&] {
        require_pointer(options, "options");
        const std::span<const double> given = checked_zernikes(count, coefficients);
        options->zernikes.assign(given.begin(), given.end());
    });
}

wfpsf_status wfpsf_options_set_opd(wfpsf_options *options, const wfpsf_image *map, double scale_m,
                                   double axis_x, double axis_y) {
    return guarded([&] {
        require_pointer(options, "options");
        if (!map) {
            options->opd_map = nullptr;
            return;
        }
        check_pupil_sampling("scale_m", scale_m, axis_x, axis_y);
        const Plane<double> samples = copy_of(*map);
        options->opd_map = std::make_shared<OpdMap>(samples.view(), scale_m, axis_x, axis_y);
    });
}

wfpsf_status wfpsf_options_set_scene_store(wfpsf_options *options, const wfpsf_scene_store *store) {
    return guarded([&] {
        require_pointer(options, "options");
        options->scene_store = store ? store->store : nullptr;
    });
}

wfpsf_status wfpsf_options_set_progress(wfpsf_options *options, wfpsf_progress progress,
                                        void *user) {
    return guarded([&] {
        require_pointer(options, "options");
        options->progress = progress;
        options->progress_user = user;
    });
}

wfpsf_status wfpsf_option_describe(int32_t key, const char **name, const char **text, int32_t *kind,
                                   double *standard, double *smallest, double *largest) {
    return guarded([&] {
        const Description &d = descriptions[index_of(key)];
        if (name)
            *name = d.name;
        if (text)
            *text = d.text;
        if (kind)
            *kind = d.kind;
        if (standard)
            *standard = d.standard;
        if (smallest)
            *smallest = d.smallest;
        if (largest)
            *largest = d.largest;
    });
}
