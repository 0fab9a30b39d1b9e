// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/link_inertias.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <map>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/dynamics/system/inertia_check.hpp"

namespace limber::scene {
namespace {

/// Moments from the three second moments s of a mass, I_i = s_j + s_k.
Vector3 find_moments(const Vector3& s) {
  return Vector3::Constant(s.sum()) - s;
}

/// Nearest moments with all second moments >= 0. Those in `zero` (bits) are 0,
/// and the others minimise the distance: then I = A s with A = ones - identity,
/// by the normal equations of its free columns.
std::optional<Vector3> project(const Vector3& moments, unsigned zero) {
  // A^T A = ones + identity, of n free: s = b - sum(b) / (n + 1), b = A^T I.
  const Vector3 b = find_moments(moments);
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < 3; ++i) {
    if ((zero >> i & 1U) != 0) continue;
    sum += b[i];
    ++count;
  }
  Vector3 s = Vector3::Zero();
  for (int i = 0; i < 3; ++i) {
    if ((zero >> i & 1U) != 0) continue;
    s[i] = b[i] - sum / (count + 1);
    if (s[i] < 0.0) return std::nullopt;
  }
  return find_moments(s);
}

Vector3 find_nearest_moments(const Vector3& moments) {
  constexpr double kLeast = 1e-6;  // of the largest, for example of a thin rod
  Vector3 best = Vector3::Zero();
  double distance = std::numeric_limits<double>::infinity();
  for (unsigned zero = 0; zero < 8; ++zero) {
    const auto one = project(moments, zero);
    if (!one || !((*one - moments).norm() < distance)) continue;
    best = *one;
    distance = (best - moments).norm();
  }
  return best.cwiseMax(kLeast * best.maxCoeff());
}

}  // namespace

void locate_inertias(const TiXmlElement& root, Robot& robot) {
  std::map<std::string, Link*> by_name;
  for (Link& link : robot.links) by_name[link.name] = &link;
  for (const TiXmlElement* link = root.FirstChildElement("link");
       link != nullptr; link = link->NextSiblingElement("link")) {
    const TiXmlElement* inertial = link->FirstChildElement("inertial");
    Link& known = *by_name.at(link->Attribute("name"));
    if (inertial == nullptr || !known.inertia) continue;
    known.inertia->place =
        fmt::format("{}:{}", robot.file.string(), inertial->Row());
  }
}

std::optional<Matrix3> find_nearest_inertia(const Matrix3& inertia) {
  if (inertia.isZero(0.0) || dynamics::find_inertia_problem(inertia).empty()) {
    return std::nullopt;
  }
  const auto pairs = dense::find_eigenpairs(inertia);
  const Vector3 moments = find_nearest_moments(pairs.values);
  if (moments.isZero(0.0)) return std::nullopt;
  return pairs.vectors * moments.asDiagonal() * pairs.vectors.transpose();
}

void repair_inertias(Robot& robot) {
  const auto describe = [](const Matrix3& I) {
    return fmt::format("ixx={:g} iyy={:g} izz={:g} ixy={:g} ixz={:g} iyz={:g}",
                       I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
  };
  for (Link& link : robot.links) {
    if (!link.inertia || link.flexible) continue;
    const auto nearest = find_nearest_inertia(link.inertia->inertia);
    if (!nearest) continue;
    robot.warnings.push_back(
        fmt::format("{}: link '{}': its inertia is physically impossible; it "
                    "is repaired, in the link's axes, from {} to {} kg m^2",
                    link.inertia->place, link.name,
                    describe(link.inertia->inertia), describe(*nearest)));
    link.inertia->inertia = *nearest;
  }
}

}  // namespace limber::scene
