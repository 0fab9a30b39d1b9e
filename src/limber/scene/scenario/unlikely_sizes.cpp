// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/scenario/unlikely_sizes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>

#include "limber/common/index.hpp"
#include "limber/common/overloaded.hpp"

namespace limber::scene {
namespace {

constexpr double kLongest = 100.0;          // [m]
constexpr double kLong = 5.0;               // [m]
constexpr double kLeastLineDensity = 0.01;  // [kg/m]
constexpr double kLeastDensity = 0.05;      // [kg/m^3]
constexpr double kMostDensity = 25000.0;    // [kg/m^3]
constexpr double kMostGyration = 3.0;       // of the shapes' extent
constexpr double kLeastGyration = 1.0 / 30.0;

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
                 [](const ConeGeometry& c) {
                   return ShapeSize{std::max(c.length, 2.0 * c.radius),
                                    kPi / 3.0 * c.radius * c.radius * c.length};
                 },
                 [](const EllipsoidGeometry& e) {
                   return ShapeSize{2.0 * e.radii.maxCoeff(),
                                    4.0 / 3.0 * kPi * e.radii.prod()};
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

/// What a link's shapes enclose: a box in the link's axes.
class Extent {
 public:
  void include(const Vector3& point, double radius) {
    lower_ = lower_.cwiseMin(point - Vector3::Constant(radius));
    upper_ = upper_.cwiseMax(point + Vector3::Constant(radius));
  }
  [[nodiscard]] double find_length() const {
    return (upper_ - lower_).maxCoeff();
  }
  [[nodiscard]] bool holds(const Vector3& point) const {
    return (point - lower_).minCoeff() >= 0.0 &&
           (upper_ - point).minCoeff() >= 0.0;
  }

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  Vector3 lower_ = Vector3::Constant(kFar);
  Vector3 upper_ = Vector3::Constant(-kFar);
};

/// Whether a link's shapes are likely the whole of it: all primitive, around
/// its centre of mass, its own frame, where its joint is, and its joints.
bool is_whole(const Link& link, double reach, const Extent& extent) {
  const bool has_sizes = std::all_of(
      link.collisions.begin(), link.collisions.end(),
      [](const Collision& c) { return find_size(c.geometry).volume > 0.0; });
  return has_sizes && !link.collisions.empty() &&
         extent.holds(link.inertia->p_LBcm) && extent.holds(Vector3::Zero()) &&
         reach <= extent.find_length();
}

/// Of mass and inertia, by the shapes.
void question_inertia(const Link& link, double reach,
                      std::vector<std::string>& questions) {
  Extent extent;
  double volume = 0.0;
  for (const Collision& collision : link.collisions) {
    const ShapeSize size = find_size(collision.geometry);
    extent.include(collision.X_LS.p, 0.5 * size.length);
    volume += size.volume;
  }
  if (!is_whole(link, reach, extent)) return;
  const double mass = link.inertia->mass;
  if (mass > kMostDensity * volume) {
    questions.push_back(
        fmt::format("link '{}' has {:.4g} kg in shapes of {:.3g} m^3, {:.3g} "
                    "kg/m^3; is its mass in kg?",
                    link.name, mass, volume, mass / volume));
    return;
  }
  const double gyration =
      std::sqrt(std::max(0.0, 0.5 * link.inertia->inertia.trace() / mass));
  const double length = extent.find_length();
  if (gyration <= kMostGyration * length &&
      gyration >= kLeastGyration * length) {
    return;
  }
  questions.push_back(
      fmt::format("link '{}' has a radius of gyration of {:.3g} m in shapes of "
                  "{:.3g} m; is its inertia in kg m^2?",
                  link.name, gyration, length));
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
    question_inertia(link, reach, questions);
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
