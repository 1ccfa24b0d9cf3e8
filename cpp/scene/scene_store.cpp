// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/scene_store.hpp"

#include "image/archive.hpp"
#include "scene/cost.hpp"

#include <utility>

namespace wfpsf {

namespace {

// The number changes with anything that is kept or how it is made, between two versions.
constexpr const char *format = "scenes 1, wfpsf " WFPSF_VERSION_TEXT;

} // namespace

KeptPsfs SceneStore::find(uint64_t key) const {
    const std::lock_guard lock(mutex_);
    const auto found = kept_.find(key);
    return found == kept_.end() ? KeptPsfs{} : found->second;
}

void SceneStore::keep(uint64_t key, const KeptPsfs &made) {
    const std::lock_guard lock(mutex_);
    KeptPsfs &kept = kept_[key];
    if (made.facts)
        kept.facts = made.facts;
    if (made.psf) {
        kept.model = made.model;
        kept.psf = made.psf;
    }
    if (made.tables) {
        kept.far = made.far;
        kept.tables = made.tables;
    }
}

int64_t SceneStore::memory() const {
    const std::lock_guard lock(mutex_);
    int64_t bytes = 0;
    for (const auto &[key, kept] : kept_) {
        if (kept.facts)
            bytes += static_cast<int64_t>(cost::far_light_memory *
                                          static_cast<double>(kept.facts->far_lights.size()));
        if (kept.psf)
            bytes += kept.psf->memory();
        if (kept.tables)
            bytes += kept.tables->memory();
    }
    return bytes;
}

void SceneStore::write(const std::string &path) const {
    const auto kept = [this] {
        const std::lock_guard lock(mutex_);
        return kept_;
    }();
    ArchiveWriter archive(path, format);
    archive(static_cast<uint64_t>(kept.size()));
    for (const auto &[key, of_key] : kept)
        archive(key, of_key);
    archive.finish();
}

void SceneStore::read(const std::string &path) {
    ArchiveReader archive(path, format);
    std::map<uint64_t, KeptPsfs> found;
    for (auto more = archive.take<uint64_t>(); more > 0; --more)
        archive(found[archive.take<uint64_t>()]);
    archive.finish();
    for (const auto &[key, kept] : found)
        keep(key, kept);
}

} // namespace wfpsf
