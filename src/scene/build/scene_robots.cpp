// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/scene_robots.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "limber/common/roll_pitch_yaw.hpp"
#include "limber/scene/robot/joined_robots.hpp"
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
                const std::vector<RobotSetting>& settings, KnownRobots* known) {
  if (known == nullptr) return read_robot(file, settings);
  constexpr std::size_t kMostKnown = 64;
  std::vector<std::string> key = {file.string()};
  for (const RobotSetting& one : settings) {
    key.push_back(to_string(one.setting));
  }
  const auto found = known->find(key);
  if (found != known->end()) return found->second;
  Robot robot = read_robot(file, settings);
  if (known->size() < kMostKnown) known->emplace(std::move(key), robot);
  return robot;
}

/// The file's robot, or none and a problem.
std::vector<NamedRobot> read_named(const RobotSpec& spec,
                                   const std::vector<RobotSetting>& settings,
                                   KnownRobots* known, Problems& problems) {
  NamedRobot named{spec.name, {}, find_pose(spec.start)};
  try {
    named.robot = read_once(spec.file, select(settings, spec.name), known);
  } catch (const InputError& error) {
    problems.add(error, 0);
    return {};
  }
  if (is_held(named.robot) && is_moving(spec.start)) {
    problems.add(0, fmt::format("[[robot]] '{}' is held by the world; it has "
                                "no velocity",
                                spec.name));
  }
  return {named};
}

}  // namespace

Robot read_robots(Scenario& scenario, const std::vector<RobotSetting>& settings,
                  KnownRobots* known) {
  if (scenario.robots.empty()) {
    return read_once(scenario.robot, settings, known);
  }
  Problems problems(scenario.file.string());
  std::vector<NamedRobot> all;
  for (const RobotSpec& spec : scenario.robots) {
    for (NamedRobot& named : read_named(spec, settings, known, problems)) {
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

}  // namespace limber::scene
