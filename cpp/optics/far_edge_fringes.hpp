// SPDX-License-Identifier: GPL-3.0-or-later
// Fringes between edges of about one direction beyond the tables of Fringes.
#pragma once

#include "optics/far_visibility.hpp"

#include <memory>
#include <vector>

namespace wfpsf {

class EdgeFringes {
  public:
    EdgeFringes() = default; // none
    EdgeFringes(const FarSource &source, const PupilEdges &edges, const EdgeColours &colours,
                std::shared_ptr<const Visibility> visibility, const std::vector<Fringes> &tables);

    // Adds fractions of the light, where they may be above the floor.
    void add(const PixelRow &row, double floor) const;

    // The most at a distance of r or more, on spikes that are close to the one given.
    double brightest(double r, const SpikeAxes &spike) const;

    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.visibility_, self.pixel_, self.scale_, self.per_across_, self.groups_);
    }

  private:
    struct Member {
        Member() = default; // none
        Member(const EdgeColours &colours, size_t edge, std::vector<ColourWaves> waves);
        double amplitude(double across) const;
        // Farther across all is fainter than that share of the brightest.
        double reach(double share) const;

        EdgeColours::Edge edge{};
        std::vector<ColourWaves> waves;

        template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
            archive(self.edge, self.waves, self.amplitude_, self.outwards_);
        }

      private:
        std::vector<double> amplitude_; // of all colours, by half pixels across
        std::vector<double> outwards_;  // the largest so many half pixels or more off the middle
    };
    struct Pair {
        size_t first, second;             // members
        double first_reach, second_reach; // across, native pixels
        double end = 0;                   // native pixels; from there on its fringes are faint
        std::vector<double> most = {};    // from each ring on
        // From there on it is fainter.
        double end_above(double floor) const;

        template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
            archive(self.first, self.second, self.first_reach, self.second_reach, self.end,
                    self.most);
        }
    };
    struct Group {
        SpikeAxes axes;
        double begin, end; // native pixels, along
        double reach;      // across
        double aside;      // of the two samples that stand for a pixel across the spike
        std::vector<Member> members = {};
        std::vector<Pair> pairs = {};

        template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
            archive(self.axes, self.begin, self.end, self.reach, self.aside, self.members,
                    self.pairs);
        }
    };
    double end_of(const Group &group, const Pair &pair) const;
    double most(const Group &group, const Pair &pair, double r) const;

    std::shared_ptr<const Visibility> visibility_;
    double pixel_ = 0, scale_ = 0, per_across_ = 0;
    std::vector<Group> groups_;
};

} // namespace wfpsf
