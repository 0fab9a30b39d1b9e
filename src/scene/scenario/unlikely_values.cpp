// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/scenario/unlikely_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "limber/flexbody/model/unlikely_values.hpp"
#include "limber/scene/scenario/unlikely_commands.hpp"
#include "limber/scene/scenario/unlikely_sizes.hpp"

namespace limber::scene {
namespace {

using Questions = std::vector<std::string>;

void append(std::vector<std::string> more, Questions& questions) {
  std::move(more.begin(), more.end(), std::back_inserter(questions));
}

/// Whether an angle is beyond a stop and would be within all as degrees.
bool fits_as_degrees(const Joint& joint, std::size_t coordinate, double angle) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  bool is_beyond = false;
  bool fits = true;
  for (const JointAction& action : joint.actions) {
    const auto* stop = std::get_if<StopOptions>(&action.law);
    if (stop == nullptr ||
        static_cast<std::size_t>(action.coordinate) != coordinate) {
      continue;
    }
    const auto is_within = [&](double value) {
      return value >= stop->lower.value_or(value) &&
             value <= stop->upper.value_or(value);
    };
    is_beyond = is_beyond || !is_within(angle);
    fits = fits && is_within(angle * kDegree);
  }
  return is_beyond && fits;
}

void question_start(const Joint& joint, const JointStart& start,
                    Questions& questions) {
  constexpr double kRound = 2.0 * std::numbers::pi;
  for (std::size_t i = 0; i < start.position.size(); ++i) {
    const double angle = start.position[i];
    if (std::abs(angle) > kRound) {
      questions.push_back(
          fmt::format("joint '{}' starts at {:g} rad, {:.1f} turns; is it in "
                      "radians?",
                      joint.name, angle, angle / kRound));
    } else if (fits_as_degrees(joint, i, angle)) {
      questions.push_back(fmt::format(
          "joint '{}' starts at {:g} rad, beyond its stop, where {:g} degrees "
          "are within it; is it in radians?",
          joint.name, angle, angle));
    }
  }
}

void question_starts(const Scenario& scenario, const Robot& robot,
                     Questions& questions) {
  for (const Joint& joint : robot.joints) {
    const auto start = scenario.joints.find(joint.name);
    if (start == scenario.joints.end() || !has_angles_alone(joint.kind)) {
      continue;
    }
    question_start(joint, start->second, questions);
  }
}

void question_gravity(const Scenario& scenario, Questions& questions) {
  constexpr double kStrongest = 100.0;  // [m/s^2]
  const double g = scenario.gravity.norm();
  if (g <= kStrongest) return;
  questions.push_back(fmt::format(
      "gravity is {:g} m/s^2; is it in m/s^2 (9.81 on the ground)?", g));
}

void question_materials(const Robot& robot, Questions& questions) {
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
}

}  // namespace

std::vector<std::string> question_scene(const Scenario& scenario,
                                        const Robot& robot) {
  Questions questions;
  question_starts(scenario, robot, questions);
  question_gravity(scenario, questions);
  question_materials(robot, questions);
  append(question_sizes(robot), questions);
  append(question_commands(scenario, robot), questions);
  return questions;
}

}  // namespace limber::scene
