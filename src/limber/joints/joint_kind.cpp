// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/joint_kind.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "limber/common/errors.hpp"

namespace limber::joints {
namespace {

// Constrained directions of a joint: projections of translation and rotation.
struct HeldDirections {
  Matrix3 translation;
  Matrix3 rotation;
};

HeldDirections find_held(JointKind kind, const Vector3& axis) {
  const Matrix3 all = Matrix3::Identity();
  const Matrix3 along = axis * axis.transpose();
  switch (kind) {
    case JointKind::revolute:
    case JointKind::continuous:
      return {all, all - along};
    case JointKind::prismatic:
      return {all - along, all};
    case JointKind::planar:
      return {along, all - along};
    case JointKind::floating:
      return {Matrix3::Zero(), Matrix3::Zero()};
    case JointKind::ball:
      return {all, Matrix3::Zero()};
    case JointKind::universal:  // constrains a rotation that rotates with M
    case JointKind::fixed:
      break;
  }
  return {all, all};
}

void check_parameters(const JointParameters& p) {
  for (const double value :
       {p.translational_stiffness, p.rotational_stiffness,
        p.translational_damping, p.rotational_damping, p.free_damping}) {
    if (!(value >= 0.0) || !std::isfinite(value)) {
      throw InputError(fmt::format(
          "joint: a stiffness or damping is {:g}; expected >= 0", value));
    }
  }
}

Vector3 find_direction(const Vector3& axis) {
  const double length = axis.norm();
  if (!(length > 0.0) || !std::isfinite(length)) {
    throw InputError("joint: its axis has no length, so no direction");
  }
  return axis / length;
}

UniversalConstraint make_universal_constraint(
    const Vector3& axis, const Vector3& second,
    const JointParameters& parameters) {
  return UniversalConstraint({
      .axis_F = axis,
      .axis_M = second,
      .translational_stiffness = parameters.translational_stiffness,
      .rotational_stiffness = parameters.rotational_stiffness,
      .translational_damping = parameters.translational_damping,
      .rotational_damping = parameters.rotational_damping,
  });
}

}  // namespace

std::string_view to_string(JointKind kind) {
  switch (kind) {
    case JointKind::fixed:
      return "fixed";
    case JointKind::revolute:
      return "revolute";
    case JointKind::continuous:
      return "continuous";
    case JointKind::prismatic:
      return "prismatic";
    case JointKind::planar:
      return "planar";
    case JointKind::floating:
      return "floating";
    case JointKind::universal:
      return "universal";
    case JointKind::ball:
      break;
  }
  return "ball";
}

bool needs_axis(JointKind kind) {
  return kind != JointKind::fixed && kind != JointKind::floating &&
         kind != JointKind::ball;
}

PlaneAxes find_plane_axes(const Vector3& axis) {
  const Matrix3 R =
      Quaternion::FromTwoVectors(Vector3::UnitZ(), axis).toRotationMatrix();
  return {R.col(0), R.col(1)};
}

std::vector<AxisCoordinate> find_coordinates(JointKind kind,
                                             const Vector3& axis_F,
                                             const Vector3& second_F) {
  const auto angle = [](const Vector3& axis) {
    return AxisCoordinate{AxisCoordinate::Kind::angle, find_direction(axis)};
  };
  const auto distance = [](const Vector3& axis) {
    return AxisCoordinate{AxisCoordinate::Kind::distance, find_direction(axis)};
  };
  switch (kind) {
    case JointKind::revolute:
    case JointKind::continuous:
      return {angle(axis_F)};
    case JointKind::prismatic:
      return {distance(axis_F)};
    case JointKind::planar: {
      const auto [x, y] = find_plane_axes(find_direction(axis_F));
      return {distance(x), distance(y), angle(axis_F)};
    }
    case JointKind::universal:
      return {angle(axis_F), angle(second_F)};
    case JointKind::ball:
      return {angle(Vector3::UnitX()), angle(Vector3::UnitY()),
              angle(Vector3::UnitZ())};
    case JointKind::fixed:
    case JointKind::floating:
      break;
  }
  return {};
}

Joint make_joint(JointKind kind, const Vector3& axis_F, const Vector3& second_F,
                 const JointParameters& parameters,
                 std::vector<JointElement> elements) {
  std::vector<AxisCoordinate> coordinates =
      find_coordinates(kind, axis_F, second_F);
  if (kind != JointKind::universal) {
    return {make_joint_bushing(kind, axis_F, parameters),
            std::move(coordinates), std::move(elements), parameters.is_ideal};
  }
  check_parameters(parameters);
  const UniversalConstraint constraint =
      make_universal_constraint(axis_F, second_F, parameters);
  if (parameters.free_damping > 0.0) {
    for (const int i : {0, 1}) {
      elements.push_back({i, Friction({.viscous = parameters.free_damping})});
    }
  }
  return {constraint, std::move(coordinates), std::move(elements),
          parameters.is_ideal};
}

Bushing make_joint_bushing(JointKind kind, const Vector3& axis_F,
                           const JointParameters& parameters) {
  LIMBER_EXPECT(kind != JointKind::universal);
  check_parameters(parameters);
  const Vector3 axis =
      needs_axis(kind) ? find_direction(axis_F) : Vector3(Vector3::UnitX());
  const HeldDirections held = find_held(kind, axis);
  const Matrix3 free_translation = Matrix3::Identity() - held.translation;
  const Matrix3 free_rotation = Matrix3::Identity() - held.rotation;
  return Bushing({
      .translational_stiffness =
          parameters.translational_stiffness * held.translation,
      .rotational_stiffness = parameters.rotational_stiffness * held.rotation,
      .translational_damping =
          parameters.translational_damping * held.translation +
          parameters.free_damping * free_translation,
      .rotational_damping = parameters.rotational_damping * held.rotation +
                            parameters.free_damping * free_rotation,
  });
}

}  // namespace limber::joints
