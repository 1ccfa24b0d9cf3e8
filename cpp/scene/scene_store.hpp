// SPDX-License-Identifier: GPL-3.0-or-later
// What scenes of the same optics are drawn with, kept from one to the next.
#pragma once

#include "optics/varying_light.hpp"
#include "scene/far_table.hpp"
#include "scene/ways.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace wfpsf {

// Of one colour on one image of a detector. What is not there has not been made.
struct KeptPsfs {
    std::shared_ptr<const ColourFacts> facts = {};
    SharedModel model = {}; // what `psf` was made for
    std::shared_ptr<const VaryingLight> psf = {};
    SharedFarLight far = {}; // what `tables` were made for
    std::shared_ptr<const FarTables> tables = {};

    bool serves(const SharedModel &wanted) const {
        return psf && model.eps == wanted.eps && model.radius == wanted.radius;
    }
    bool serves(const SharedFarLight &wanted) const {
        return tables && far.exact_radius == wanted.exact_radius &&
               far.exact_eps <= wanted.exact_eps && far.radius == wanted.radius &&
               far.floor <= wanted.floor && far.differences_floor <= wanted.differences_floor &&
               far.differences_radius >= wanted.differences_radius;
    }
    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.facts, self.model, self.psf, self.far, self.tables);
    }
};

// Holds for every key what was kept last. Thread-safe.
class SceneStore {
  public:
    KeptPsfs find(uint64_t key) const;
    void keep(uint64_t key, const KeptPsfs &made); // what of it was made
    int64_t memory() const;                        // bytes, about

    // To a file, in place of one that is there; and from one, in place of what is kept of the same
    // keys.
    void write(const std::string &path) const;
    void read(const std::string &path);

  private:
    mutable std::mutex mutex_;
    std::map<uint64_t, KeptPsfs> kept_;
};

// How scenes share what they are drawn with.
struct SceneReuse {
    std::shared_ptr<SceneStore> store = {}; // none: each makes its own
    // That many scenes are expected: what they share may take as many times as long.
    double scenes = 1;
};

} // namespace wfpsf
