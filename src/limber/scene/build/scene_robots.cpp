// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/scene_robots.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "limber/common/roll_pitch_yaw.hpp"
#include "limber/scene/robot/joined_robots.hpp"
#include "limber/scene/robot/massless_links.hpp"
#include "limber/scene/robot/robot_reader.hpp"
#include "limber/scene/text/problems.hpp"

namespace limber::scene {
namespace {

Pose find_pose(const BodyStart& start) {
  return {rotation_rpy(start.orientation_rpy), start.position};
}

bool is_moving(const BodyStart& start) {
  return !start.velocity.isZero(0.0) || !start.angular_velocity.isZero(0.0);
}

/// Velocity of a floating joint in the frame of the robot's start.
JointStart find_start(const BodyStart& start) {
  const Matrix3 R_RW = find_pose(start).R.transpose();
  const Vector3 v = R_RW * start.velocity;
  const Vector3 w = R_RW * start.angular_velocity;
  return {{}, {v[0], v[1], v[2], w[0], w[1], w[2]}};
}

std::vector<RobotSetting> select(const std::vector<RobotSetting>& settings,
                                 const std::string& robot) {
  std::vector<RobotSetting> own;
  for (const RobotSetting& setting : settings) {
    if (setting.robot == robot) own.push_back(setting);
  }
  return own;
}

/// The file's robot, read once with the same settings.
Robot read_once(const std::filesystem::path& file,
                const std::vector<RobotSetting>& settings,
                const RobotOptions& options, KnownRobots* known) {
  if (known == nullptr) return read_robot(file, settings, options);
  constexpr std::size_t kMostKnown = 64;
  std::vector<std::string> key = {file.string(),
                                  options.repair_inertia ? "repair" : ""};
  for (const auto& [name, folder] : options.packages) {
    key.push_back(name + "=" + folder.string());
  }
  for (const RobotSetting& one : settings) {
    key.push_back(to_string(one.setting));
  }
  const auto found = known->find(key);
  if (found != known->end()) return found->second;
  Robot robot = read_robot(file, settings, options);
  if (known->size() < kMostKnown) known->emplace(std::move(key), robot);
  return robot;
}

/// Whether the robot's root link is to be fixed to the world, which it is not
/// by itself.
bool needs_fixed_base(const std::string& who, const Robot& robot,
                      const std::optional<RobotBase>& base,
                      std::vector<std::string>& warnings) {
  if (is_held(robot)) {
    if (base) {
      warnings.push_back(fmt::format(
          "{} base changes nothing: the root link '{}' is already fixed", who,
          robot.links.front().name));
    }
    return false;
  }
  if (base) return base == RobotBase::fixed;
  if (!has_massless_root(robot)) return false;
  warnings.push_back(fmt::format(
      "{} the root link '{}' has no mass, so it is fixed to the world where it "
      "stands (base = \"fixed\")",
      who, robot.links.front().name));
  return true;
}

/// The robot with ideal joints, and a warning of those that its file makes
/// elastic.
Robot make_ideal(const std::string& who, Robot robot,
                 std::vector<std::string>& warnings) {
  robot = make_joints_ideal(std::move(robot));
  std::vector<std::string> elastic;
  for (const Joint& joint : robot.joints) {
    if (joint.coupler.is_elastic()) elastic.push_back(joint.name);
  }
  if (!elastic.empty()) {
    warnings.push_back(fmt::format(
        "{} joint = \"ideal\" leaves {} of {} joints elastic, whose stiffness "
        "or damping the robot's file gives: '{}'",
        who, elastic.size(), robot.joints.size(), fmt::join(elastic, "', '")));
  }
  return robot;
}

Robot read_and_fix_robot(Scenario& scenario,
                         const std::vector<RobotSetting>& settings,
                         KnownRobots* known) {
  Robot robot = read_once(scenario.robot, settings, scenario.urdf, known);
  if (!needs_fixed_base("[robot]", robot, scenario.robot_base,
                        scenario.warnings)) {
    return robot;
  }
  if (is_moving(scenario.base)) {
    throw InputError(fmt::format(
        "{}: [initial.base] has a velocity, but the root link is fixed",
        scenario.file.string()));
  }
  robot = fix_base(std::move(robot), find_pose(scenario.base));
  scenario.base = {};
  return robot;
}

Robot read_only_robot(Scenario& scenario,
                      const std::vector<RobotSetting>& settings,
                      KnownRobots* known) {
  Robot robot = read_and_fix_robot(scenario, settings, known);
  if (scenario.robot_joint == JointModel::stiff) return robot;
  return make_ideal("[robot]", std::move(robot), scenario.warnings);
}

/// The file's robot, or none and a problem.
std::vector<NamedRobot> read_named(const RobotSpec& spec,
                                   const std::vector<RobotSetting>& settings,
                                   const RobotOptions& options,
                                   KnownRobots* known, Problems& problems,
                                   std::vector<std::string>& warnings) {
  NamedRobot named{spec.name, {}, find_pose(spec.start)};
  try {
    named.robot =
        read_once(spec.file, select(settings, spec.name), options, known);
  } catch (const InputError& error) {
    problems.add(error, 0);
    return {};
  }
  const std::string who = fmt::format("[[robot]] '{}':", spec.name);
  if (spec.joint == JointModel::ideal) {
    named.robot = make_ideal(who, std::move(named.robot), warnings);
  }
  named.is_fixed = needs_fixed_base(who, named.robot, spec.base, warnings);
  if ((is_held(named.robot) || named.is_fixed) && is_moving(spec.start)) {
    problems.add(0, fmt::format("[[robot]] '{}' is held by the world; it has "
                                "no velocity",
                                spec.name));
  }
  return {named};
}

Robot read_several(Scenario& scenario,
                   const std::vector<RobotSetting>& settings,
                   KnownRobots* known) {
  Problems problems(scenario.file.string());
  std::vector<NamedRobot> all;
  for (const RobotSpec& spec : scenario.robots) {
    for (NamedRobot& named : read_named(spec, settings, scenario.urdf, known,
                                        problems, scenario.warnings)) {
      all.push_back(std::move(named));
    }
    if (scenario.joints.contains(spec.name)) {
      problems.add(0, fmt::format("[initial.joints] '{}' is a robot; give its "
                                  "position and velocity in its [[robot]]",
                                  spec.name));
    }
    if (is_moving(spec.start))
      scenario.joints[spec.name] = find_start(spec.start);
  }
  problems.raise();
  Robot joined = join_robots(all);
  joined.name = scenario.name;
  joined.file = scenario.file;
  return joined;
}

}  // namespace

std::set<std::string> find_used_joints(const Scenario& scenario) {
  std::set<std::string> used;
  for (const auto& [joint, start] : scenario.joints) used.insert(joint);
  for (const DriveSpec& drive : scenario.drives) used.insert(drive.joint);
  for (const ProbeSpec& probe : scenario.probes) {
    const auto* coupler = std::get_if<CouplerProbeSpec>(&probe.of);
    if (coupler != nullptr) used.insert(coupler->coupler);
  }
  return used;
}

Robot read_robots(Scenario& scenario, const std::vector<RobotSetting>& settings,
                  KnownRobots* known) {
  return scenario.robots.empty() ? read_only_robot(scenario, settings, known)
                                 : read_several(scenario, settings, known);
}

}  // namespace limber::scene
