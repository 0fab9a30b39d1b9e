// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/link_motion.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/common/index.hpp"
#include "limber/common/names.hpp"
#include "limber/common/roll_pitch_yaw.hpp"
#include "limber/dynamics/terms/kinematics.hpp"
#include "limber/joints/joint_motion.hpp"
#include "limber/scene/text/problems.hpp"

namespace limber::scene {
namespace {

/// Motion of the child's frame from that of its parent.
LinkMotion follow(const LinkMotion& parent, const Joint& joint,
                  JointStart start) {
  // A gear may have passed one to a joint that has none, which is told later.
  const std::size_t count = joints::coordinate_count(joint.kind);
  start.position.resize(count, 0.0);
  start.velocity.resize(count, 0.0);
  const dynamics::FrameMotion F =
      dynamics::follow({parent.X_WL, parent.v_WL_W, parent.w_WL_W},
                       {.R_FM = joint.X_PJ.R, .p_FM_F = joint.X_PJ.p});
  const dynamics::FrameMotion M = dynamics::follow(
      F, joints::find_joint_motion({joint.kind, joint.axis_J, joint.second_J},
                                   start));
  return {M.X_WF, M.v_WF_W, M.w_WF_W};
}

LinkMotion free_motion(const BodyStart& start) {
  return {{rotation_rpy(start.orientation_rpy), start.position},
          start.velocity,
          start.angular_velocity};
}

const Joint* named_joint(const Robot& robot, const std::string& name) {
  for (const Joint& joint : robot.joints) {
    if (joint.name == name) return &joint;
  }
  return nullptr;
}

void check_start(const Robot& robot, const std::string& name,
                 const JointStart& start, Problems& problems) {
  const Joint* joint = named_joint(robot, name);
  if (joint == nullptr) {
    std::vector<std::string> known;
    for (const Joint& j : robot.joints) known.push_back(j.name);
    problems.add(0,
                 "[initial.joints] " + describe_unknown("joint", name, known));
    return;
  }
  const std::size_t count = joints::coordinate_count(joint->kind);
  for (const std::vector<double>* values : {&start.position, &start.velocity}) {
    if (values->empty() || values->size() == count) continue;
    problems.add(0, fmt::format("[initial.joints.{}] has {} numbers; a joint "
                                "of this kind has {} coordinate(s)",
                                name, values->size(), count));
  }
}

void check_starts(const Robot& robot, const Scenario& scenario) {
  Problems problems(scenario.file.string());
  for (const auto& [name, start] : scenario.joints) {
    check_start(robot, name, start, problems);
  }
  const BodyStart& base = scenario.base;
  const double motion = base.position.norm() + base.orientation_rpy.norm() +
                        base.velocity.norm() + base.angular_velocity.norm();
  if (robot.has_world_root() && motion > 0.0) {
    problems.add(0,
                 "[initial.base] moves the root link, but the robot's root is "
                 "'world'; set joints instead");
  }
  problems.raise();
}

std::vector<LinkMotion> place_links(
    const Robot& robot, const Scenario& scenario,
    const std::map<std::string, JointStart>& starts) {
  std::vector<LinkMotion> motions(robot.links.size());
  motions.front() = free_motion(scenario.base);
  for (const Joint& joint : robot.joints) {
    const auto start = starts.find(joint.name);
    motions[static_cast<std::size_t>(joint.child)] =
        follow(motions[static_cast<std::size_t>(joint.parent)], joint,
               start == starts.end() ? JointStart{} : start->second);
  }
  for (std::size_t i = robot.tree_size(); i < robot.links.size(); ++i) {
    motions[i] =
        free_motion(scenario.projectiles.at(i - robot.tree_size()).start);
  }
  return motions;
}

/// Sets the start of one joint of a gear from that of the other.
void pass_start(const Gear& gear, std::map<std::string, JointStart>& starts) {
  const auto value = [](const std::vector<double>& values) {
    return values.empty() ? 0.0 : values.front();
  };
  const double r = gear.ratio;
  if (const auto with = starts.find(gear.with); with != starts.end()) {
    starts[gear.joint] = {{r * value(with->second.position) + gear.offset},
                          {r * value(with->second.velocity)}};
    return;
  }
  const JointStart& start = starts.at(gear.joint);
  starts[gear.with] = {{(value(start.position) - gear.offset) / r},
                       {value(start.velocity) / r}};
}

}  // namespace

std::map<std::string, JointStart> find_joint_starts(const Robot& robot,
                                                    const Scenario& scenario) {
  std::map<std::string, JointStart> starts = scenario.joints;
  const auto is_known = [&](const std::string& joint) {
    return starts.count(joint) != 0;
  };
  // A loop's coordinate follows from those of the tree.
  std::vector<Gear> gears;
  for (const Gear& gear : robot.gears) {
    if (named_joint(robot, gear.joint) != nullptr &&
        named_joint(robot, gear.with) != nullptr) {
      gears.push_back(gear);
    }
  }
  while (true) {
    auto gear = std::find_if(gears.begin(), gears.end(), [&](const Gear& g) {
      return is_known(g.joint) != is_known(g.with);
    });
    if (gear != gears.end()) {
      pass_start(*gear, starts);
      continue;
    }
    // One of several geared joints without a start is at zero.
    gear = std::find_if(gears.begin(), gears.end(),
                        [&](const Gear& g) { return !is_known(g.with); });
    if (gear == gears.end()) return starts;
    starts[gear->with] = {};
  }
}

std::vector<LinkMotion> find_link_motions(const Robot& robot,
                                          const Scenario& scenario) {
  check_starts(robot, scenario);
  return place_links(robot, scenario, find_joint_starts(robot, scenario));
}

std::vector<PlacedBody> find_placed_bodies(const BodyPlans& plans) {
  std::vector<PlacedBody> bodies;
  for (const BodyPlan& plan : plans.bodies) {
    if (plan.is_world) continue;
    const int link = plan.links.front();
    bodies.push_back({link, find_X_BL(plans, link, plan.piece).inverse()});
  }
  return bodies;
}

void follow_links(const std::vector<PlacedBody>& bodies,
                  const std::vector<LinkMotion>& motions,
                  dynamics::SystemState& state) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const LinkMotion& motion = motions[index(bodies[i].link)];
    const Pose X_WB = motion.X_WL * bodies[i].X_LB;
    dynamics::BodyState& body = state.bodies[i];
    body.p_WB = X_WB.p;
    body.quat_WB = Quaternion(X_WB.R).normalized();
    body.v_WB_W = motion.v_WL_W + motion.w_WL_W.cross(X_WB.p - motion.X_WL.p);
    body.w_WB_B = X_WB.R.transpose() * motion.w_WL_W;
  }
}

std::vector<LinkMotion> find_motions_at_zero(const Robot& robot,
                                             const Scenario& scenario) {
  return place_links(robot, scenario, {});
}

}  // namespace limber::scene
