// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/default_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"

namespace limber::dynamics {
namespace {

/// Principal flexibilities below this fraction of the largest are of directions
/// that the interface does not define, such as the rotation of a line of nodes
/// about itself [-].
constexpr double kUndefined = 1e-12;

/// Acceleration by rounding that is allowed in a default joint [m/s^2].
constexpr double kRoundingAcceleration = 1e-3;

/// Smallest principal flexibility of the 3 x 3 block at `first`; infinite if
/// the side is rigid.
double find_flexibility(const CouplerSide& side, int first) {
  if (!side.flexibility) return kInfinity;
  const Matrix3 block = side.flexibility->block<3, 3>(first, first);
  const Vector3 ascending =
      dense::find_eigenvalues(Matrix3(0.5 * (block + block.transpose())));
  const double least = kUndefined * ascending.maxCoeff();
  for (const double flexibility : ascending) {
    if (flexibility > least) return flexibility;
  }
  return kInfinity;
}

/// 1 / (1/a + 1/b), for infinite values too.
double reduce(double a, double b) {
  if (std::isinf(a)) return b;
  if (std::isinf(b)) return a;
  return a * b / (a + b);
}

double stiffness_at(double frequency, double mu) {
  const double omega = 2.0 * std::numbers::pi * frequency;
  return mu * omega * omega;
}

/// Stiffness and damping of a coupler's translations or rotations.
struct Constraint {
  double stiffness = 0.0;
  double damping = 0.0;
};

Constraint make_constraint(double stiffness, double ratio, double mu) {
  return {stiffness, 2.0 * ratio * std::sqrt(stiffness * mu)};
}

/// @param flexibility of the stiffer side @param mu mass or moment of inertia
/// of both sides @param least stiffness by which rigid sides carry their load
Constraint find_constraint(const std::optional<double>& stiffness,
                           const std::optional<double>& damping,
                           double flexibility, double mu, double least,
                           double rigid_frequency) {
  Constraint constraint;
  if (stiffness) {
    constraint = make_constraint(*stiffness, kDampingRatio, mu);
  } else if (std::isfinite(flexibility)) {
    constraint =
        make_constraint(kStiffnessRatio / flexibility, kDampingRatio, mu);
  } else {
    constraint =
        make_constraint(std::max(stiffness_at(rigid_frequency, mu), least),
                        kRigidDampingRatio, mu);
  }
  if (damping) constraint.damping = *damping;
  return constraint;
}

}  // namespace

CouplerSide make_side(double mass, const Matrix3& inertia,
                      const Vector3& p_BF) {
  CouplerSide side;
  side.mass = mass;
  side.inertia = inertia.trace() / 3.0 + mass * p_BF.squaredNorm();
  return side;
}

joints::JointParameters find_joint_parameters(const CouplerOptions& options,
                                              const CouplerSide& side_F,
                                              const CouplerSide& side_M,
                                              const CarriedLoad& load,
                                              double rigid_frequency) {
  const auto flexibility = [&](int first) {
    return std::min(find_flexibility(side_F, first),
                    find_flexibility(side_M, first));
  };
  const Constraint translation = find_constraint(
      options.translational_stiffness, options.translational_damping,
      flexibility(0), reduce(side_F.mass, side_M.mass),
      load.force / (kRigidFraction * load.size), rigid_frequency);
  const Constraint rotation =
      find_constraint(options.rotational_stiffness, options.rotational_damping,
                      flexibility(3), reduce(side_F.inertia, side_M.inertia),
                      load.moment / kRigidFraction, rigid_frequency);
  joints::JointParameters parameters;
  parameters.free_damping = options.free_damping.value_or(0.0);
  if (options.is_ideal.value_or(false)) {
    if (options.is_elastic()) {
      throw InputError(
          "an ideal joint does not deflect, so it has no stiffness and no "
          "damping but that of free directions");
    }
    parameters.is_ideal = true;
    const auto stiffen = [&](double k, int first) {
      return std::isfinite(flexibility(first))
                 ? kIdealStiffnessRatio / kStiffnessRatio * k
                 : k;
    };
    parameters.translational_stiffness = stiffen(translation.stiffness, 0);
    parameters.rotational_stiffness = stiffen(rotation.stiffness, 3);
    return parameters;
  }
  parameters.translational_stiffness = translation.stiffness;
  parameters.rotational_stiffness = rotation.stiffness;
  parameters.translational_damping = translation.damping;
  parameters.rotational_damping = rotation.damping;
  return parameters;
}

double find_rigid_frequency(double distance) {
  const double rounding =
      std::numeric_limits<double>::epsilon() * std::abs(distance);
  const double omega = std::sqrt(kRoundingAcceleration / rounding);
  return std::clamp(omega / (2.0 * std::numbers::pi), kLeastRigidFrequency,
                    kRigidFrequency);
}

StopStiffness find_stop_stiffness(const CouplerSide& side_F,
                                  const CouplerSide& side_M) {
  return {stiffness_at(kStopFrequency, reduce(side_F.mass, side_M.mass)),
          stiffness_at(kStopFrequency, reduce(side_F.inertia, side_M.inertia))};
}

}  // namespace limber::dynamics
