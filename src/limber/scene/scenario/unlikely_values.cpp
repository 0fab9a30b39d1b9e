// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/scenario/unlikely_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "limber/flexbody/model/unlikely_values.hpp"
#include "limber/scene/scenario/unlikely_angles.hpp"
#include "limber/scene/scenario/unlikely_commands.hpp"
#include "limber/scene/scenario/unlikely_sizes.hpp"

namespace limber::scene {
namespace {

using Questions = std::vector<std::string>;

void append(std::vector<std::string> more, Questions& questions) {
  std::move(more.begin(), more.end(), std::back_inserter(questions));
}

void question_gravity(const Scenario& scenario, Questions& questions) {
  constexpr double kStrongest = 100.0;  // [m/s^2]
  const double g = scenario.gravity.norm();
  if (g <= kStrongest) return;
  questions.push_back(fmt::format(
      "gravity is {:g} m/s^2; is it in m/s^2 (9.81 on the ground)?", g));
}

void question_friction(const Scenario& scenario, Questions& questions) {
  constexpr double kMost = 3.0;  // of soft rubber
  for (const ContactSpec& contact : scenario.contacts) {
    const double friction = contact.options.friction.value_or(0.0);
    if (friction <= kMost) continue;
    questions.push_back(fmt::format(
        "[[contact]] between '{}' and '{}' has a friction of {:g}, more than "
        "that of rubber; is it a coefficient (steel on steel: 0.2)?",
        contact.between[0], contact.between[1], friction));
  }
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
  Questions questions = question_angles(scenario, robot);
  question_gravity(scenario, questions);
  question_friction(scenario, questions);
  question_materials(robot, questions);
  append(question_sizes(robot), questions);
  append(question_commands(scenario, robot), questions);
  return questions;
}

}  // namespace limber::scene
