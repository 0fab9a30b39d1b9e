// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/motion_groups.hpp"

#include <algorithm>
#include <cmath>

#include "limber/common/index.hpp"
#include "limber/dynamics/bodies/body.hpp"
#include "limber/dynamics/system/linked_groups.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {

MotionGroups::MotionGroups(const SystemModel& model)
    : group_of_(model.bodies.size()) {
  for (const CoupledGroup& group : find_coupled_groups(model)) {
    for (const BodyIndex b : group.bodies) group_of_[index(b)] = count();
    is_held_.push_back(group.is_held ? 1 : 0);
  }
  common_.resize(count());
}

std::size_t MotionGroups::find(std::size_t group) const {
  while (common_[group].with != group) group = common_[group].with;
  return group;
}

void MotionGroups::join_touching(const SystemModel& model,
                                 const SystemTerms& terms) {
  for (std::size_t g = 0; g < count(); ++g) {
    common_[g] = {.with = g, .is_held = is_held_[g] != 0};
  }
  for (std::size_t i = 0; i < model.pairs.size(); ++i) {
    if (terms.pairs.responses[i].points().empty()) continue;
    const Pair& pair = model.pairs[i];
    const BodyIndex first = pair.body_A == kWorld ? pair.body_B : pair.body_A;
    const BodyIndex other = pair.body_A == kWorld ? kWorld : pair.body_B;
    Common& common = common_[find_joined(index(first))];
    if (other == kWorld) {
      common.is_held = true;
      continue;
    }
    const std::size_t to = find_joined(index(other));
    common_[to].is_held = common_[to].is_held || common.is_held;
    common.with = to;
  }
}

void MotionGroups::measure_motion(const SystemModel& model,
                                  const SystemState& state,
                                  const SystemTerms& terms,
                                  const VectorX& motion,
                                  std::vector<double>& lengths) {
  join_touching(model, terms);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    Common& common = common_[find_joined(b)];
    const double mass = model.bodies[b].mass;
    common.mass += mass;
    common.momentum += mass * visit_body(model, b, [&](const auto& own) {
                         return own.find_translation(state, motion);
                       });
  }
  for (Common& common : common_) {
    if (!common.is_held && common.mass > 0.0) {
      common.translation = common.momentum / common.mass;
    }
  }
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    Common& common = common_[find_joined(b)];
    common.squared = std::max(
        common.squared, visit_body(model, b, [&](const auto& own) {
          return own.measure_squared(state, motion, common.translation);
        }));
  }
  for (std::size_t g = 0; g < count(); ++g) {
    lengths[g] = std::sqrt(common_[find(g)].squared);
  }
}

}  // namespace limber::dynamics
