// SPDX-License-Identifier: BSD-3-Clause
#include "scene/link_motion.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/names.hpp"
#include "common/rotation.hpp"
#include "scene/xml_element.hpp"

namespace limber::scene {
namespace {

/// Motion of the child's frame in the joint frame.
struct JointMotion {
  Pose X_JC;
  Vector3 v_JC_J = Vector3::Zero();
  Vector3 w_JC_J = Vector3::Zero();
};

std::vector<double> padded(std::vector<double> values, std::size_t count) {
  values.resize(count, 0.0);
  return values;
}

JointMotion planar_motion(const Vector3& axis, const std::vector<double>& q,
                          const std::vector<double>& u) {
  const auto [x, y] = joints::find_plane_axes(axis);
  JointMotion motion;
  motion.X_JC.p = q[0] * x + q[1] * y;
  motion.X_JC.R = exp_rotation(q[2] * axis);
  motion.v_JC_J = u[0] * x + u[1] * y;
  motion.w_JC_J = u[2] * axis;
  return motion;
}

JointMotion find_joint_motion(const Joint& joint, const JointStart& start) {
  const std::size_t count = coordinate_count(joint.kind);
  const std::vector<double> q = padded(start.position, count);
  const std::vector<double> u = padded(start.velocity, count);
  JointMotion motion;
  switch (joint.kind) {
    case joints::JointKind::fixed:
      break;
    case joints::JointKind::revolute:
    case joints::JointKind::continuous:
      motion.X_JC.R = exp_rotation(q[0] * joint.axis_J);
      motion.w_JC_J = u[0] * joint.axis_J;
      break;
    case joints::JointKind::prismatic:
      motion.X_JC.p = q[0] * joint.axis_J;
      motion.v_JC_J = u[0] * joint.axis_J;
      break;
    case joints::JointKind::planar:
      return planar_motion(joint.axis_J, q, u);
    case joints::JointKind::floating:
      motion.X_JC.p = Vector3(q[0], q[1], q[2]);
      motion.X_JC.R = rotation_rpy(Vector3(q[3], q[4], q[5]));
      motion.v_JC_J = Vector3(u[0], u[1], u[2]);
      motion.w_JC_J = Vector3(u[3], u[4], u[5]);
      break;
    case joints::JointKind::universal:
      motion.X_JC.R = exp_rotation(q[0] * joint.axis_J);
      motion.w_JC_J =
          u[0] * joint.axis_J + u[1] * (motion.X_JC.R * joint.second_J);
      motion.X_JC.R = motion.X_JC.R * exp_rotation(q[1] * joint.second_J);
      break;
    case joints::JointKind::ball:
      motion.X_JC.R = rotation_rpy(Vector3(q[0], q[1], q[2]));
      motion.w_JC_J = Vector3(u[0], u[1], u[2]);
      break;
  }
  return motion;
}

LinkMotion follow(const LinkMotion& parent, const Joint& joint,
                  const JointMotion& relative) {
  const Pose X_WJ = parent.X_WL * joint.X_PJ;
  LinkMotion child;
  child.X_WL = X_WJ * relative.X_JC;
  child.w_WL_W = parent.w_WL_W + X_WJ.R * relative.w_JC_J;
  child.v_WL_W = parent.v_WL_W +
                 parent.w_WL_W.cross(child.X_WL.p - parent.X_WL.p) +
                 X_WJ.R * relative.v_JC_J;
  return child;
}

LinkMotion root_motion(const BaseStart& base) {
  return {{rotation_rpy(base.orientation_rpy), base.position},
          base.velocity,
          base.angular_velocity};
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
  const std::size_t count = coordinate_count(joint->kind);
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
  const BaseStart& base = scenario.base;
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
    const Robot& robot, const BaseStart& base,
    const std::map<std::string, JointStart>& starts) {
  std::vector<LinkMotion> motions(robot.links.size());
  motions.front() = root_motion(base);
  for (const Joint& joint : robot.joints) {
    const auto start = starts.find(joint.name);
    const JointMotion relative = find_joint_motion(
        joint, start == starts.end() ? JointStart{} : start->second);
    motions[static_cast<std::size_t>(joint.child)] = follow(
        motions[static_cast<std::size_t>(joint.parent)], joint, relative);
  }
  return motions;
}

/// Gives one of a gear's joints the start that the other has.
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

std::size_t coordinate_count(joints::JointKind kind) {
  switch (kind) {
    case joints::JointKind::fixed:
      return 0;
    case joints::JointKind::universal:
      return 2;
    case joints::JointKind::planar:
    case joints::JointKind::ball:
      return 3;
    case joints::JointKind::floating:
      return 6;
    default:
      return 1;
  }
}

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
    // Of joints that hang together and have no start, one stays at zero.
    gear = std::find_if(gears.begin(), gears.end(),
                        [&](const Gear& g) { return !is_known(g.with); });
    if (gear == gears.end()) return starts;
    starts[gear->with] = {};
  }
}

std::vector<LinkMotion> find_link_motions(const Robot& robot,
                                          const Scenario& scenario) {
  check_starts(robot, scenario);
  return place_links(robot, scenario.base, find_joint_starts(robot, scenario));
}

std::vector<LinkMotion> find_motions_at_zero(const Robot& robot,
                                             const Scenario& scenario) {
  return place_links(robot, scenario.base, {});
}

}  // namespace limber::scene
