// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/group_motion.hpp"

#include <algorithm>
#include <numeric>

#include "limber/common/index.hpp"
#include "limber/dynamics/system/linked_groups.hpp"

namespace limber::dynamics {
namespace {

using Index = Eigen::Index;

/// Appends `count` coordinates from `first` on; @returns their new first.
Index append_range(Index first, Index count, std::vector<Index>& coordinates) {
  const Index place = std::ssize(coordinates);
  coordinates.resize(static_cast<std::size_t>(place + count));
  std::iota(coordinates.begin() + place, coordinates.end(), first);
  return place;
}

/// Links that the coordinates move.
void take_links(const SmallMotion& motion, const std::vector<Index>& x,
                SmallMotion& part) {
  const MatrixX G = motion.G(Eigen::all, x);
  std::vector<Index> rows;
  for (std::size_t i = 0; i < motion.K.size(); ++i) {
    const Index row = 6 * static_cast<Index>(i);
    if (G.middleRows<6>(row).isZero(0.0)) continue;
    append_range(row, 6, rows);
    part.K.push_back(motion.K[i]);
  }
  part.G = G(rows, Eigen::all);
}

}  // namespace

GroupMotion take_group(const SystemModel& model, const SmallMotion& motion,
                       const std::vector<BodyIndex>& group) {
  GroupMotion out;
  SmallMotion& part = out.motion;
  std::vector<Index>& x = out.coordinates;
  part.bodies = group;
  part.places.assign(motion.places.size(), -1);
  part.modes.assign(motion.modes.size(), 0);
  for (const BodyIndex b : group) {
    const Index p = motion.places[index(b)];
    if (p >= 0) part.places[index(b)] = append_range(p, 6, x);
    const Index m = motion.modes[index(b)];
    const Index first = append_range(m, model.bodies[index(b)].modes, x);
    part.modes[index(b)] = first;
    if (model.bodies[index(b)].modes == 0) continue;
    for (const SmallMotion::ModalBlock& block : motion.coupled) {
      if (block.first == m) part.coupled.push_back({first, block.K});
    }
    for (const SmallMotion::Relaxation& r : motion.relaxations) {
      if (r.first != m) continue;
      part.relaxations.push_back({first, r.weights, r.time});
    }
  }
  part.M = motion.M(x, x);
  part.D = motion.D(x, x);
  part.lambda = motion.lambda(x);
  part.rest = motion.rest(x, x);
  part.noise = motion.noise(x, x);
  take_links(motion, x, part);
  return out;
}

std::vector<GroupMotion> split_groups(const SystemModel& model,
                                      const SmallMotion& motion) {
  std::vector<GroupMotion> parts;
  for (const auto& group : find_linked_groups(model)) {
    const bool is_of_it = std::find(motion.bodies.begin(), motion.bodies.end(),
                                    group.front()) != motion.bodies.end();
    if (!is_of_it) continue;
    GroupMotion part = take_group(model, motion, group);
    if (part.motion.size() > 0) parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace limber::dynamics
