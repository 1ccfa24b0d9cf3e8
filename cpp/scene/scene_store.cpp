// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/scene_store.hpp"

#include "scene/cost.hpp"

namespace wfpsf {

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

} // namespace wfpsf
