// SPDX-License-Identifier: BSD-3-Clause
#include "joints/joint_kind.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"

namespace limber::joints {
namespace {

// Which directions a joint holds: projections of translation and rotation.
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
    case JointKind::fixed:
      break;
  }
  return {all, all};
}

void check_parameters(const JointParameters& p) {
  for (const double value :
       {p.translational_stiffness, p.rotational_stiffness,
        p.translational_damping, p.rotational_damping, p.free_damping}) {
    if (!(value >= 0.0)) {
      throw InputError(fmt::format(
          "joint: a stiffness or damping is {:g}; expected >= 0", value));
    }
  }
}

}  // namespace

Bushing make_joint_bushing(JointKind kind, const Vector3& axis_F,
                           const JointParameters& parameters) {
  check_parameters(parameters);
  const bool needs_axis =
      kind != JointKind::fixed && kind != JointKind::floating;
  const double length = axis_F.norm();
  if (needs_axis && !(length > 0.0)) {
    throw InputError("joint: its axis has no length, so no direction");
  }
  const Vector3 axis = needs_axis ? Vector3(axis_F / length) : Vector3::UnitX();
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
