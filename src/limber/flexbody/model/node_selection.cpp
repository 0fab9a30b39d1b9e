// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/node_selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/common/overloaded.hpp"

namespace limber::flexbody {
namespace {

/// All digits, so that different numbers give different text; -0 is 0.
std::string to_text(const Vector3& v) {
  return fmt::format("{},{},{}", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);
}

std::string to_point(const Vector3& v) {
  return fmt::format("({:g}, {:g}, {:g})", v.x() + 0.0, v.y() + 0.0,
                     v.z() + 0.0);
}

}  // namespace

PlaneNodes make_plane(const Vector3& point, const Vector3& normal,
                      double tolerance) {
  if (normal.isZero(0.0)) {
    throw InputError("the plane's normal is zero; give it a direction");
  }
  return {point, normal.stableNormalized(), tolerance};
}

CylinderNodes make_cylinder(const Vector3& from, const Vector3& to,
                            double radius, double inner_radius) {
  if (from == to) {
    throw InputError(
        fmt::format("the two ends of the cylinder's axis are both {} m; take "
                    "them apart",
                    to_point(from)));
  }
  if (inner_radius > radius) {
    throw InputError(
        fmt::format("the cylinder's inner radius {:g} m is above its radius "
                    "{:g} m",
                    inner_radius, radius));
  }
  return {from, to, radius, inner_radius};
}

bool is_single_node(const NodeSelection& nodes) {
  return std::holds_alternative<TaggedNode>(nodes) ||
         std::holds_alternative<NearestNode>(nodes);
}

std::string name_of(const NodeSelection& nodes) {
  return std::visit(
      Overloaded{
          [](const GroupNodes& group) { return "group:" + group.group; },
          [](const TaggedNode& node) {
            return fmt::format("node:{}", node.tag);
          },
          [](const NearestNode& node) {
            return "nearest:" + to_text(node.point);
          },
          [](const BoxNodes& box) {
            return "box:" + to_text(box.lower) + ":" + to_text(box.upper);
          },
          [](const PlaneNodes& plane) {
            return fmt::format("plane:{}:{}:{}", to_text(plane.point),
                               to_text(plane.normal), plane.tolerance);
          },
          [](const CylinderNodes& cylinder) {
            return fmt::format("cylinder:{}:{}:{}:{}", to_text(cylinder.from),
                               to_text(cylinder.to), cylinder.radius,
                               cylinder.inner_radius);
          }},
      nodes);
}

std::string describe(const NodeSelection& nodes) {
  return std::visit(
      Overloaded{
          [](const GroupNodes& group) {
            return fmt::format("the group '{}'", group.group);
          },
          [](const TaggedNode& node) {
            return fmt::format("the node {}", node.tag);
          },
          [](const NearestNode& node) {
            return fmt::format("the node nearest to {} m",
                               to_point(node.point));
          },
          [](const BoxNodes& box) {
            return fmt::format("the box from {} to {} m", to_point(box.lower),
                               to_point(box.upper));
          },
          [](const PlaneNodes& plane) {
            return fmt::format(
                "the plane through {} m normal to {}{}", to_point(plane.point),
                to_point(plane.normal),
                plane.tolerance > 0.0
                    ? fmt::format(" within {:g} m", plane.tolerance)
                    : "");
          },
          [](const CylinderNodes& cylinder) {
            return fmt::format(
                "the cylinder from {} to {} m of radius {:g} m{}",
                to_point(cylinder.from), to_point(cylinder.to), cylinder.radius,
                cylinder.inner_radius > 0.0
                    ? fmt::format(" outside {:g} m", cylinder.inner_radius)
                    : "");
          }},
      nodes);
}

double calc_distance(const BoxNodes& box, const Vector3& p_M) {
  return (p_M - p_M.cwiseMax(box.lower).cwiseMin(box.upper)).norm();
}

double calc_distance(const PlaneNodes& plane, const Vector3& p_M) {
  return std::abs(plane.normal.dot(p_M - plane.point));
}

double calc_distance(const CylinderNodes& cylinder, const Vector3& p_M) {
  const Vector3 axis = cylinder.to - cylinder.from;
  const double length = axis.norm();
  const Vector3 d = p_M - cylinder.from;
  const double along = d.dot(axis) / length;
  const double across = (d - along / length * axis).norm();
  const double beyond = std::max({0.0, -along, along - length});
  const double beside =
      std::max({0.0, across - cylinder.radius, cylinder.inner_radius - across});
  return std::hypot(beyond, beside);
}

double find_tolerance(const BoxNodes& /*box*/, double body_size) {
  constexpr double kRoundoff = 1e-9;
  return kRoundoff * body_size;
}

double find_tolerance(const PlaneNodes& plane, double body_size) {
  return plane.tolerance > 0.0 ? plane.tolerance : kNearness * body_size;
}

double find_tolerance(const CylinderNodes& /*cylinder*/, double body_size) {
  return kNearness * body_size;
}

}  // namespace limber::flexbody
