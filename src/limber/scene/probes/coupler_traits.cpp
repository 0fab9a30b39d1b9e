// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/probes/coupler_traits.hpp"

#include <variant>

namespace limber::scene {
namespace {

CouplerTraits describe_joint(const Robot& robot, const Joint& joint) {
  CouplerTraits traits{joint.name, true,
                       static_cast<int>(count_coordinates(joint.kind)), ""};
  if (merges(robot, joint)) {
    traits.why_none = "joins two rigid links into one body";
  } else if (joint.kind == joints::JointKind::floating &&
             joint.coupler.free_damping.value_or(0.0) == 0.0) {
    traits.why_none = "leaves everything free, undamped";
  }
  return traits;
}

}  // namespace

std::vector<CouplerTraits> find_coupler_traits(const Robot& robot) {
  std::vector<CouplerTraits> all;
  for (const Joint& joint : robot.joints) {
    all.push_back(describe_joint(robot, joint));
  }
  for (const Loop& loop : robot.loops) {
    all.push_back(
        {loop.name, true, static_cast<int>(count_coordinates(loop.kind)), ""});
  }
  for (const Connector& connector : robot.connectors) {
    const bool is_spring = std::holds_alternative<SpringOptions>(connector.law);
    all.push_back({connector.name, true, is_spring ? 1 : 0, ""});
  }
  for (const Latch& latch : robot.latches) {
    all.push_back({latch.name, true, 0, ""});
  }
  for (const Tendon& tendon : robot.tendons) {
    all.push_back({tendon.name, false, 1, ""});
  }
  for (const Gear& gear : robot.gears) all.push_back({gear.name, false, 1, ""});
  return all;
}

}  // namespace limber::scene
