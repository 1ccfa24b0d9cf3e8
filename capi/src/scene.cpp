// SPDX-License-Identifier: GPL-3.0-or-later
#include "funnel.hpp"
#include "handles.hpp"
#include "scene/plan.hpp"
#include "scene/render.hpp"
#include "scene/truth.hpp"
#include "scene_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

using namespace wfpsf;

namespace {

double property_of(const ScenePlan &plan, int32_t key) {
    switch (key) {
    case WFPSF_SCENE_SOURCES:
        return static_cast<double>(plan.sources().size());
    case WFPSF_SCENE_GROUPS:
        return static_cast<double>(plan.groups().size());
    case WFPSF_SCENE_ERROR_ALLOWED:
        return plan.budget().error();
    case WFPSF_SCENE_ERROR_EXPECTED:
        return plan.error();
    case WFPSF_SCENE_TIME_EXPECTED:
        return plan.time_s();
    case WFPSF_SCENE_MEMORY_EXPECTED:
        return static_cast<double>(plan.memory());
    default:
        fail(WFPSF_ERROR_UNKNOWN_NAME, "key = %d: a scene has no property of that key", key);
    }
}

double property_of(const PlannedGroup &planned, int32_t key) {
    const SourceGroup &group = planned.group;
    switch (key) {
    case WFPSF_SCENE_GROUP_COLOUR:
        return group.colour;
    case WFPSF_SCENE_GROUP_KIND:
        return group.is_galaxy ? WFPSF_KIND_GALAXY : WFPSF_KIND_STAR;
    case WFPSF_SCENE_GROUP_FLUX_FROM:
        return std::ldexp(1.0, group.octave);
    case WFPSF_SCENE_GROUP_SOURCES:
        return static_cast<double>(group.count);
    case WFPSF_SCENE_GROUP_DRAWING:
        return static_cast<double>(planned.way.drawing) + 1;
    case WFPSF_SCENE_GROUP_RADIUS:
        return planned.way.radius;
    case WFPSF_SCENE_GROUP_EPS:
        return planned.way.eps;
    case WFPSF_SCENE_GROUP_FAR_FLOOR:
        return planned.way.far;
    case WFPSF_SCENE_GROUP_ERROR_EXPECTED:
        return planned.error.local + planned.error.mean;
    case WFPSF_SCENE_GROUP_TIME_EXPECTED:
        return planned.time_s;
    default:
        fail(WFPSF_ERROR_UNKNOWN_NAME, "key = %d: a group has no property of that key", key);
    }
}

double property_of(const RenderReport &report, int32_t key) {
    switch (key) {
    case WFPSF_RENDERING_TIME:
        return report.time_s();
    case WFPSF_RENDERING_TIME_MODELS:
        return report.models_s;
    case WFPSF_RENDERING_TIME_SHARED:
        return report.shared_s;
    case WFPSF_RENDERING_TIME_OWN:
        return report.own_s;
    case WFPSF_RENDERING_TIME_GALAXIES:
        return report.galaxies_s;
    case WFPSF_RENDERING_DRAWN:
        return static_cast<double>(report.drawn);
    case WFPSF_RENDERING_EXACT_PSFS:
        return static_cast<double>(report.exact_psfs);
    case WFPSF_RENDERING_ERROR_ESTIMATE:
        return report.error;
    default:
        fail(WFPSF_ERROR_UNKNOWN_NAME, "key = %d: a rendering has no property of that key", key);
    }
}

wfpsf_status certify_scene(double error, double allowed) {
    if (error <= allowed)
        return WFPSF_OK;
    char line[128];
    std::snprintf(line, sizeof line, "SCENE_NOISE: allows errors of %g e-, the estimate is %g e-",
                  allowed, error);
    return record_error(WFPSF_WARNING_NOT_CERTIFIED, line);
}

} // namespace

wfpsf_status wfpsf_scene_store_create(wfpsf_scene_store **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        *out = new wfpsf_scene_store{std::make_shared<SceneStore>()};
    });
}

void wfpsf_scene_store_destroy(wfpsf_scene_store *store) {
    delete store;
}

wfpsf_status wfpsf_scene_store_memory(const wfpsf_scene_store *store, int64_t *bytes) {
    return guarded([&] {
        require_pointer(store, "store");
        require_pointer(bytes, "bytes");
        *bytes = store->store->memory();
    });
}

wfpsf_status wfpsf_scene_store_write(const wfpsf_scene_store *store, const char *path) {
    return guarded([&] {
        require_pointer(store, "store");
        require_pointer(path, "path");
        store->store->write(path);
    });
}

wfpsf_status wfpsf_scene_store_read(wfpsf_scene_store *store, const char *path) {
    return guarded([&] {
        require_pointer(store, "store");
        require_pointer(path, "path");
        store->store->read(path);
    });
}

wfpsf_status wfpsf_scene_create(const wfpsf_instrument *instrument,
                                const wfpsf_observation *observation, const char *band, int32_t sca,
                                const wfpsf_catalogue *catalogue, const wfpsf_image *image,
                                double x0, double y0, const wfpsf_options *options,
                                wfpsf_scene **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(instrument, "instrument");
        require_pointer(band, "band");
        require_pointer(catalogue, "catalogue");
        require_pointer(image, "image");
        require_finite(x0, "x0");
        require_finite(y0, "y0");
        const Image &target = image->image;
        if (target.nx() == 0 || target.ny() == 0)
            fail(WFPSF_ERROR_SIZE, "image: is empty");
        const Instrument &i = instrument->instrument;
        const Catalogue &sources = catalogue->catalogue;
        SceneOptics optics = scene_optics(*instrument, band, sca, options);
        optics.lights = lights_of(sources, i.band(band));
        const double zero_flux = zero_flux_of(sources, i, band, options);
        std::vector<PlacedSource> placed =
            sources.placed(observation ? &observation->observation : nullptr, sca, zero_flux);
        ScenePlan plan(optics, std::move(placed), sources.shapes(), budget_of(i, options),
                       {x0, y0, target.nx(), target.ny(), target.oversampling()},
                       scene_reuse(options),
                       static_cast<int>(option(options, WFPSF_OPTION_THREADS)));
        auto made = std::make_unique<wfpsf_scene>(
            wfpsf_scene{std::move(optics), std::move(plan), sources.size()});
        const ScenePlan &planned = made->plan;
        *out = made.release();
        return certify_scene(planned.error(), planned.budget().error());
    });
}

void wfpsf_scene_destroy(wfpsf_scene *scene) {
    delete scene;
}

wfpsf_status wfpsf_scene_get(const wfpsf_scene *scene, int32_t key, double *value) {
    return guarded([&] {
        require_pointer(scene, "scene");
        require_pointer(value, "value");
        *value = property_of(scene->plan, key);
    });
}

wfpsf_status wfpsf_scene_get_group(const wfpsf_scene *scene, int64_t group, int32_t key,
                                   double *value) {
    return guarded([&] {
        require_pointer(scene, "scene");
        require_pointer(value, "value");
        const auto &groups = scene->plan.groups();
        if (group < 0 || group >= static_cast<int64_t>(groups.size()))
            fail(WFPSF_ERROR_RANGE, "group = %lld: must be 0..%zu", static_cast<long long>(group),
                 groups.size() - 1);
        *value = property_of(groups[static_cast<size_t>(group)], key);
    });
}

wfpsf_status wfpsf_scene_groups_of(const wfpsf_scene *scene, int64_t count, int32_t *group) {
    return guarded([&] {
        require_pointer(scene, "scene");
        const std::span groups = array_of(count, group, "count", "group");
        if (groups.size() != scene->catalogue_size)
            fail(WFPSF_ERROR_SIZE, "count = %zu: the catalogue has %zu sources", groups.size(),
                 scene->catalogue_size);
        std::ranges::fill(groups, -1);
        for (const PlacedSource &source : scene->plan.sources())
            groups[static_cast<size_t>(source.index)] =
                static_cast<int32_t>(scene->plan.group_index(source));
    });
}

wfpsf_status wfpsf_scene_text(const wfpsf_scene *scene, int64_t capacity, char *text,
                              int64_t *length) {
    return guarded([&] {
        require_pointer(scene, "scene");
        copy_text(scene->plan.text(), capacity, text, length);
    });
}

wfpsf_status wfpsf_scene_render(const wfpsf_scene *scene, const wfpsf_options *options,
                                wfpsf_image *image, wfpsf_rendering **out) {
    return guarded([&] {
        if (out)
            *out = nullptr;
        require_pointer(scene, "scene");
        require_pointer(image, "image");
        Image &target = image->image;
        const SceneImage &planned = scene->plan.image();
        if (target.nx() != planned.nx || target.ny() != planned.ny ||
            target.oversampling() != planned.oversampling)
            fail(WFPSF_ERROR_SIZE,
                 "image: has %lld x %lld samples, %d a pixel; the scene is planned for %lld x "
                 "%lld, %lld a pixel",
                 static_cast<long long>(target.nx()), static_cast<long long>(target.ny()),
                 target.oversampling(), static_cast<long long>(planned.nx),
                 static_cast<long long>(planned.ny), static_cast<long long>(planned.oversampling));
        const PsfSettings &settings = scene->optics.settings;
        require_light(settings, scene->optics.pixel_scale_arcsec, target, options);
        const auto threads = static_cast<int>(option(options, WFPSF_OPTION_THREADS));
        auto made = std::make_unique<wfpsf_rendering>(std::visit(
            [&](auto pixels) {
                return wfpsf_rendering{
                    render(scene->optics, scene->plan, pixels, threads, manners_of(options))};
            },
            target.pixels()));
        record_light(settings, scene->optics.pixel_scale_arcsec, target);
        const double error = made->report.error;
        if (out)
            *out = made.release();
        return certify_scene(error, scene->plan.budget().error());
    });
}

void wfpsf_rendering_destroy(wfpsf_rendering *rendering) {
    delete rendering;
}

wfpsf_status wfpsf_rendering_get(const wfpsf_rendering *rendering, int32_t key, double *value) {
    return guarded([&] {
        require_pointer(rendering, "rendering");
        require_pointer(value, "value");
        *value = property_of(rendering->report, key);
    });
}

wfpsf_status wfpsf_scene_truth(const wfpsf_scene *scene, int64_t count, const int64_t *sources,
                               const wfpsf_ipc_kernel *kernel, const wfpsf_options *options,
                               double *values) {
    return guarded([&] {
        require_pointer(scene, "scene");
        const std::span all = array_of(count, values, "count", "values");
        const auto size = static_cast<int64_t>(scene->catalogue_size);
        // Where each source of the catalogue stands in the plan.
        std::vector<const PlacedSource *> placed(scene->catalogue_size);
        for (const PlacedSource &source : scene->plan.sources())
            placed[static_cast<size_t>(source.index)] = &source;
        std::vector<PlacedSource> asked;
        std::vector<int64_t> rows;
        for (int64_t i = 0; i < count; ++i) {
            const int64_t index = sources ? sources[i] : i;
            if (index < 0 || index >= size)
                fail(WFPSF_ERROR_RANGE, "sources[%lld] = %lld: must be 0..%lld",
                     static_cast<long long>(i), static_cast<long long>(index),
                     static_cast<long long>(size - 1));
            if (placed[static_cast<size_t>(index)]) {
                asked.push_back(*placed[static_cast<size_t>(index)]);
                rows.push_back(i);
            }
        }
        const std::vector<SourceTruth> truths =
            truth_of(scene->optics, scene->plan, asked,
                     {.eps = option(options, WFPSF_OPTION_EPS),
                      .moments_tolerance = option(options, WFPSF_OPTION_MOMENTS_TOLERANCE),
                      .kernel = kernel ? &kernel->kernel : nullptr,
                      .threads = static_cast<int>(option(options, WFPSF_OPTION_THREADS))});
        constexpr int64_t columns = WFPSF_TRUTH_COLUMNS;
        for (int64_t i = 0; i < count; ++i) {
            std::fill_n(values + i * columns, columns, NAN);
            values[i * columns + WFPSF_TRUTH_GROUP] = -1;
        }
        for (size_t i = 0; i < rows.size(); ++i) {
            double *const row = values + rows[i] * columns;
            const PlacedSource &source = asked[i];
            const SourceTruth &truth = truths[i];
            row[WFPSF_TRUTH_GROUP] = static_cast<double>(scene->plan.group_index(source));
            row[WFPSF_TRUTH_POSITION_X] = source.x;
            row[WFPSF_TRUTH_POSITION_Y] = source.y;
            row[WFPSF_TRUTH_FLUX] = source.flux;
            row[WFPSF_TRUTH_FLUX_IN_STAMP] = truth.flux_in_stamp;
            row[WFPSF_TRUTH_STATUS] = truth.status;
            const auto put = [row](int64_t first, const TrueShape &shape) {
                row[first] = shape.x;
                row[first + 1] = shape.y;
                row[first + 2] = shape.sigma;
                row[first + 3] = shape.e1;
                row[first + 4] = shape.e2;
            };
            put(WFPSF_TRUTH_CENTROID_X, truth.bare);
            put(WFPSF_TRUTH_IPC_CENTROID_X, truth.with_ipc);
        }
    });
}
