// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/scenario/unlikely_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "limber/flexbody/model/unlikely_values.hpp"

namespace limber::scene {
namespace {

bool has_angles_alone(joints::JointKind kind) {
  using enum joints::JointKind;
  return kind == revolute || kind == continuous || kind == universal;
}

}  // namespace

std::vector<std::string> question_scene(const Scenario& scenario,
                                        const Robot& robot) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  constexpr double kStrongest = 100.0;  // [m/s^2]
  std::vector<std::string> questions;
  for (const Joint& joint : robot.joints) {
    const auto start = scenario.joints.find(joint.name);
    if (start == scenario.joints.end() || !has_angles_alone(joint.kind)) {
      continue;
    }
    for (const double angle : start->second.position) {
      if (std::abs(angle) <= kTurn) continue;
      questions.push_back(
          fmt::format("joint '{}' starts at {:g} rad, {:.1f} turns; is it in "
                      "radians?",
                      joint.name, angle, angle / kTurn));
    }
  }
  if (const double g = scenario.gravity.norm(); g > kStrongest) {
    questions.push_back(fmt::format(
        "gravity is {:g} m/s^2; is it in m/s^2 (9.81 on the ground)?", g));
  }
  for (const Link& link : robot.links) {
    if (!link.flexible) continue;
    for (const flexbody::MaterialRegion& region : link.flexible->materials) {
      const auto found = flexbody::question_material(region);
      std::transform(found.begin(), found.end(), std::back_inserter(questions),
                     [&](const std::string& text) {
                       return fmt::format("link '{}': {}", link.name, text);
                     });
    }
  }
  return questions;
}

}  // namespace limber::scene
