// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/scenario/unlikely_sizes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "limber/common/index.hpp"
#include "limber/common/overloaded.hpp"

namespace limber::scene {
namespace {

constexpr double kLongest = 100.0;          // [m]
constexpr double kLong = 5.0;               // [m]
constexpr double kLeastLineDensity = 0.01;  // [kg/m]
constexpr double kLeastDensity = 0.05;      // [kg/m^3]

struct ShapeSize {
  double length = 0.0;  ///< [m]
  double volume = 0.0;  ///< [m^3]
};

ShapeSize find_size(const Geometry& geometry) {
  constexpr double kPi = std::numbers::pi;
  return std::visit(
      Overloaded{[](const SphereGeometry& s) {
                   const double r = s.radius;
                   return ShapeSize{2.0 * r, 4.0 / 3.0 * kPi * r * r * r};
                 },
                 [](const BoxGeometry& b) {
                   return ShapeSize{b.size.maxCoeff(), b.size.prod()};
                 },
                 [](const CylinderGeometry& c) {
                   return ShapeSize{std::max(c.length, 2.0 * c.radius),
                                    kPi * c.radius * c.radius * c.length};
                 },
                 [](const CapsuleGeometry& c) {
                   return ShapeSize{c.length + 2.0 * c.radius,
                                    kPi * c.radius * c.radius * c.length};
                 },
                 [](const auto& /*unknown*/) { return ShapeSize{}; }},
      geometry);
}

/// From a link's own frame to its joints, by link [m].
std::vector<double> find_reaches(const Robot& robot) {
  std::vector<double> reaches(robot.links.size(), 0.0);
  for (const Joint& joint : robot.joints) {
    if (joint.kind == joints::JointKind::floating) continue;
    double& reach = reaches[index(joint.parent)];
    reach = std::max(reach, joint.X_PJ.p.norm());
  }
  return reaches;
}

/// @param reach of its joints [m]
void question(const Link& link, double reach,
              std::vector<std::string>& questions) {
  const double mass = link.inertia->mass;
  double length = std::max(reach, link.inertia->p_LBcm.norm());
  double volume = 0.0;
  for (const Collision& collision : link.collisions) {
    const ShapeSize size = find_size(collision.geometry);
    length = std::max(length, size.length);
    volume += size.volume;
  }
  if (length <= kLongest &&
      (length <= kLong || mass >= kLeastLineDensity * length) &&
      mass >= kLeastDensity * volume) {
    return;
  }
  questions.push_back(fmt::format(
      "link '{}' is {:.3g} m long and has {:.3g} kg; are its lengths in metres "
      "(1 mm = 0.001)?",
      link.name, length, mass));
}

}  // namespace

std::vector<std::string> question_sizes(const Robot& robot) {
  std::vector<std::string> questions;
  const std::vector<double> reaches = find_reaches(robot);
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    const Link& link = robot.links[i];
    if (link.flexible || !link.inertia || !(link.inertia->mass > 0.0)) continue;
    question(link, reaches[i], questions);
  }
  return questions;
}

}  // namespace limber::scene
