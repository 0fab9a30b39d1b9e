// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/records/fields.hpp"
#include "limber/joints/coordinates/motion.hpp"
#include "limber/joints/coordinates/required_rotations.hpp"

namespace limber::joints {

/// Constraint springs of a universal joint: they keep the two origins together,
/// and an axis a of F normal to an axis b of M.
///
/// Equation   V = kt p' p / 2 + kr s^2 / 2, s = a . R_FM b;
///            dissipation ct v' v + cr sdot^2
/// Source     the constraint of a universal joint's cross, with compliance
/// Limits     the moment varies as sin(2 x) with the tilt x of b towards a: a
///            tilt of pi / 2 is an unstable equilibrium.
class UniversalConstraint {
 public:
  struct Parameters {
    Vector3 axis_F = Vector3::UnitX();     ///< a, normalised [-]
    Vector3 axis_M = Vector3::UnitY();     ///< b, normalised; normal to a [-]
    double translational_stiffness = 0.0;  ///< kt >= 0 [N/m]
    double rotational_stiffness = 0.0;     ///< kr >= 0 [N m/rad]
    double translational_damping = 0.0;    ///< ct >= 0 [N s/m]
    double rotational_damping = 0.0;       ///< cr >= 0 [N m s/rad]
  };

  /// @throws InputError if the axes are not normal to each other, or a value
  /// is outside its range.
  explicit UniversalConstraint(const Parameters& parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] CouplerResponse evaluate(const RelativeMotion& motion) const;
  /// The direction of its moment, a x R b, is normal to a in F and to b in M.
  [[nodiscard]] RequiredSides find_required_rotations() const;

 private:
  Parameters parameters_;
};

constexpr auto fields_of(const UniversalConstraint::Parameters*) {
  return list_fields(
      "universal joint", "axis of F", "axis of M",
      "translational stiffness [N/m]", "rotational stiffness [N m/rad]",
      "translational damping [N s/m]", "rotational damping [N m s/rad]");
}

/// Stiffness and deflection: the distance of the origins, and the sine s as the
/// angle.
[[nodiscard]] ConstraintStiffness find_constraint_stiffness(
    const UniversalConstraint& constraint);
/// Deflection p and s, about the normal of both axes.
[[nodiscard]] ConstraintGap find_constraint_gap(
    const UniversalConstraint& constraint, const RelativeMotion& motion);
[[nodiscard]] ConstraintDeflection find_deflection(
    const UniversalConstraint& constraint, const ConstraintStiffness& stiffness,
    const RelativeMotion& motion);

}  // namespace limber::joints
