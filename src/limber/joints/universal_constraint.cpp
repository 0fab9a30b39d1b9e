// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/universal_constraint.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limber/common/errors.hpp"

namespace limber::joints {

UniversalConstraint::UniversalConstraint(const Parameters& parameters)
    : parameters_(parameters) {
  Parameters& p = parameters_;
  for (const double value : {p.translational_stiffness, p.rotational_stiffness,
                             p.translational_damping, p.rotational_damping}) {
    if (!(value >= 0.0) || !std::isfinite(value)) {
      throw InputError(fmt::format(
          "universal joint: a stiffness or damping is {:g}; expected >= 0",
          value));
    }
  }
  const double lengths = p.axis_F.norm() * p.axis_M.norm();
  if (!(lengths > 0.0)) {
    throw InputError("universal joint: an axis has no length, so no direction");
  }
  constexpr double kNormal = 1e-9;
  const double cosine = p.axis_F.dot(p.axis_M) / lengths;
  if (!(std::abs(cosine) < kNormal)) {
    throw InputError(fmt::format(
        "universal joint: its axes are not normal to each other (the cosine of "
        "their angle is {:g}; expected less than {:g})",
        cosine, kNormal));
  }
  p.axis_F.normalize();
  p.axis_M.normalize();
}

CouplerResponse UniversalConstraint::evaluate(
    const RelativeMotion& motion) const {
  const Parameters& p = parameters_;
  const Vector3& a = p.axis_F;
  const Vector3 b = motion.R_FM * p.axis_M;
  const double s = a.dot(b);
  const Vector3 h = b.cross(a);  // ds = h . dphi
  const double rate = h.dot(motion.w_FM_F);
  const Matrix3 dh = b * a.transpose() - s * Matrix3::Identity();
  const double push = p.rotational_stiffness * s + p.rotational_damping * rate;

  CouplerResponse response;
  response.wrench.head<3>() = -p.translational_stiffness * motion.p_FM_F -
                              p.translational_damping * motion.v_FM_F;
  response.wrench.tail<3>() = -push * h;
  response.energy =
      0.5 * p.translational_stiffness * motion.p_FM_F.squaredNorm() +
      0.5 * p.rotational_stiffness * s * s;
  response.dissipation = p.translational_damping * motion.v_FM_F.squaredNorm() +
                         p.rotational_damping * rate * rate;
  const Vector3 rate_change = dh.transpose() * motion.w_FM_F;
  response.stiffness.topLeftCorner<3, 3>().diagonal().setConstant(
      p.translational_stiffness);
  response.stiffness.bottomRightCorner<3, 3>() =
      h * (p.rotational_stiffness * h + p.rotational_damping * rate_change)
              .transpose() +
      push * dh;
  response.damping.topLeftCorner<3, 3>().diagonal().setConstant(
      p.translational_damping);
  response.damping.bottomRightCorner<3, 3>() =
      p.rotational_damping * h * h.transpose();
  return response;
}

RequiredSides UniversalConstraint::find_required_rotations() const {
  const Parameters& p = parameters_;
  if (p.rotational_stiffness == 0.0 && p.rotational_damping == 0.0) return {};
  const auto normal_to = [](const Vector3& axis) -> Matrix3 {
    return Matrix3::Identity() - rotation_about(axis.normalized());
  };
  return {normal_to(p.axis_F), normal_to(p.axis_M)};
}

ConstraintStiffness find_constraint_stiffness(
    const UniversalConstraint& constraint) {
  return {constraint.parameters().translational_stiffness,
          constraint.parameters().rotational_stiffness};
}

ConstraintGap find_constraint_gap(const UniversalConstraint& constraint,
                                  const RelativeMotion& motion) {
  const Vector3& a = constraint.parameters().axis_F;
  const Vector3 b = motion.R_FM * constraint.parameters().axis_M;
  const Vector3 normal = b.cross(a).normalized();
  ConstraintGap gap;
  gap.directions.topLeftCorner<3, 3>().setIdentity();
  gap.directions.bottomRightCorner<3, 3>() = normal * normal.transpose();
  gap.gap << -motion.p_FM_F, -a.dot(b) * normal;
  return gap;
}

ConstraintDeflection find_deflection(const UniversalConstraint& constraint,
                                     const ConstraintStiffness& stiffness,
                                     const RelativeMotion& motion) {
  const UniversalConstraint::Parameters& p = constraint.parameters();
  ConstraintDeflection deflection;
  if (stiffness.translational > 0.0) deflection.distance = motion.p_FM_F.norm();
  if (stiffness.rotational > 0.0) {
    deflection.rotation = std::abs(p.axis_F.dot(motion.R_FM * p.axis_M));
  }
  return deflection;
}

}  // namespace limber::joints
