// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/default_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limber/common/dense/symmetric_eigen.hpp"

namespace limber::dynamics {
namespace {

/// Largest principal flexibility of the 3 x 3 block at `first`; infinite if
/// the side is rigid.
double find_flexibility(const CouplerSide& side, int first) {
  if (!side.flexibility) return kInfinity;
  const Matrix3 block = side.flexibility->block<3, 3>(first, first);
  const Matrix3 symmetric = 0.5 * (block + block.transpose());
  const double largest = dense::find_eigenvalues(symmetric).maxCoeff();
  return largest > 0.0 ? largest : kInfinity;
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

double find_stiffness(const CouplerSide& side_F, const CouplerSide& side_M,
                      int first, double mu, double carried) {
  const double flexibility = std::min(find_flexibility(side_F, first),
                                      find_flexibility(side_M, first));
  if (std::isfinite(flexibility)) return kStiffnessRatio / flexibility;
  return std::max(stiffness_at(kRigidFrequency, mu), carried / kRigidShare);
}

double find_damping(double stiffness, double mu) {
  return 2.0 * kDampingRatio * std::sqrt(stiffness * mu);
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
                                              const CarriedLoad& load) {
  const double mass = reduce(side_F.mass, side_M.mass);
  const double inertia = reduce(side_F.inertia, side_M.inertia);
  joints::JointParameters parameters;
  parameters.translational_stiffness = options.translational_stiffness.value_or(
      find_stiffness(side_F, side_M, 0, mass, load.force / load.size));
  parameters.rotational_stiffness = options.rotational_stiffness.value_or(
      find_stiffness(side_F, side_M, 3, inertia, load.moment));
  parameters.translational_damping = options.translational_damping.value_or(
      find_damping(parameters.translational_stiffness, mass));
  parameters.rotational_damping = options.rotational_damping.value_or(
      find_damping(parameters.rotational_stiffness, inertia));
  parameters.free_damping = options.free_damping.value_or(0.0);
  return parameters;
}

StopStiffness find_stop_stiffness(const CouplerSide& side_F,
                                  const CouplerSide& side_M) {
  return {stiffness_at(kStopFrequency, reduce(side_F.mass, side_M.mass)),
          stiffness_at(kStopFrequency, reduce(side_F.inertia, side_M.inertia))};
}

}  // namespace limber::dynamics
