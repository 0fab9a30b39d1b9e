// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/bushing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"

namespace limber::joints {
namespace {

// Relative tolerance for symmetry and for eigenvalues that should be zero [-].
constexpr double kRoundoff = 1e-12;
// Relative to the largest principal value: smaller ones are round-off of the
// matrix [-].
constexpr double kFree = 1e-14;

template <typename Matrix>
void check_semidefinite(const Matrix& m, const std::string& what) {
  if (!m.allFinite()) {
    throw InputError(fmt::format("bushing: {} is not finite", what));
  }
  const double scale = m.cwiseAbs().maxCoeff();
  if ((m - m.transpose()).cwiseAbs().maxCoeff() > kRoundoff * scale) {
    throw InputError(fmt::format("bushing: {} is not symmetric", what));
  }
  const double lowest = dense::find_eigenvalues(m).minCoeff();
  if (lowest < -kRoundoff * scale) {
    throw InputError(fmt::format(
        "bushing: {} has a negative eigenvalue {:g}; it would supply energy",
        what, lowest));
  }
}

// Checks the blocks one by one, then together, each scaled so that its largest
// entry is 1.
void check_form(const Matrix3& translational, const Matrix3& rotational,
                const Matrix3& coupling, const std::string& what) {
  check_semidefinite(translational, "translational " + what);
  check_semidefinite(rotational, "rotational " + what);
  if (coupling.isZero(0.0)) return;
  const auto unit = [](const Matrix3& m) {
    const double largest = m.cwiseAbs().maxCoeff();
    return largest > 0.0 ? 1.0 / std::sqrt(largest) : 1.0;
  };
  const double t = unit(translational);
  const double r = unit(rotational);
  Matrix6 scaled;
  scaled << t * t * translational, t * r * coupling,
      t * r * coupling.transpose(), r * r * rotational;
  check_semidefinite(scaled, what + " with its coupling");
}

// (A32 - A23, A13 - A31, A21 - A12).
Vector3 vee(const Matrix3& A) {
  return {A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1)};
}

Matrix3 find_chordal(const Matrix3& rotational_stiffness) {
  return 0.5 * rotational_stiffness.trace() * Matrix3::Identity() -
         rotational_stiffness;
}

Matrix3 normalised(const Matrix3& matrix) {
  const double size = matrix.norm();
  return size > 0.0 ? Matrix3(matrix / size) : matrix;
}

double find_largest(const Matrix3& stiffness) {
  return dense::find_eigenvalues(stiffness).maxCoeff();
}

// Checks the parameters before they are used.
const Bushing::Parameters& check(const Bushing::Parameters& p) {
  check_form(p.translational_stiffness, p.rotational_stiffness,
             p.coupling_stiffness, "stiffness");
  check_form(p.translational_damping, p.rotational_damping, p.coupling_damping,
             "damping");
  return p;
}

}  // namespace

Bushing::PrincipalForm::PrincipalForm(const Matrix3& m) {
  const auto form = dense::find_eigenpairs(m);
  values = form.values;
  axes = form.vectors;
  const double least = kFree * values.cwiseAbs().maxCoeff();
  values = (values.array().abs() <= least).select(0.0, values);
}

Bushing::Bushing(const Parameters& parameters)
    : parameters_(check(parameters)),
      D_(find_chordal(parameters.rotational_stiffness)),
      principal_D_(D_),
      principal_Kt_(parameters.translational_stiffness),
      principal_Ct_(parameters.translational_damping),
      principal_Cr_(parameters.rotational_damping),
      is_coupled_(!parameters.coupling_stiffness.isZero(0.0) ||
                  !parameters.coupling_damping.isZero(0.0)) {
  if (is_coupled_) return;
  // A spring moment is normal to the axis of a D of rank one.
  const auto& Kt = principal_Kt_;
  const Eigen::Array3i held = (principal_D_.values.array() != 0.0).cast<int>();
  const bool is_hinge = held.sum() == 1;
  free_translations_ = find_free_axes(
      Kt.axes, (Kt.values.array() == 0.0).cast<int>(), principal_Ct_);
  free_rotations_ =
      find_free_axes(principal_D_.axes,
                     is_hinge ? held : Eigen::Array3i::Zero(), principal_Cr_);
}

// Only axes for which damping causes no force normal to them.
std::vector<Bushing::FreeAxis> Bushing::find_free_axes(
    const Matrix3& axes, const Eigen::Array3i& is_free,
    const PrincipalForm& damping) {
  std::vector<FreeAxis> free;
  const double round = kFree * damping.values.cwiseAbs().maxCoeff();
  for (int i = 0; i < 3; ++i) {
    if (is_free[i] == 0) continue;
    const Vector3 axis = axes.col(i);
    const Vector3 force = damping.apply(axis);
    const double along = axis.dot(force);
    if ((force - along * axis).norm() > round) continue;
    free.push_back({axis, along > round ? along : 0.0});
  }
  return free;
}

Vector3 Bushing::clear(const std::vector<FreeAxis>& free, const Vector3& rate,
                       const Vector3& force) {
  Vector3 cleared = force;
  for (const auto& [axis, damping] : free) {
    cleared -= (axis.dot(cleared) + damping * axis.dot(rate)) * axis;
  }
  return cleared;
}

CouplerResponse Bushing::evaluate(const RelativeMotion& motion) const {
  const Parameters& p = parameters_;
  const Vector3 spring_force = principal_Kt_.apply(motion.p_FM_F);
  const Vector3 damper_force = principal_Ct_.apply(motion.v_FM_F);
  const Vector3 damper_moment = principal_Cr_.apply(motion.w_FM_F);

  CouplerResponse response;
  response.wrench.head<3>() = -spring_force - damper_force;
  response.wrench.tail<3>() = -damper_moment;
  response.energy = 0.5 * motion.p_FM_F.dot(spring_force);
  // I - R first: no cancellation at R = I, nor normal to the rotation axis.
  const Matrix3 gaps = motion.R_FM * principal_D_.axes - principal_D_.axes;
  for (int i = 0; i < 3; ++i) {
    const double D = principal_D_.values[i];
    const Vector3 gap = gaps.col(i);
    response.wrench.tail<3>() -= D * principal_D_.axes.col(i).cross(gap);
    response.energy += 0.5 * D * gap.squaredNorm();
  }
  response.wrench.head<3>() =
      clear(free_translations_, motion.v_FM_F, response.wrench.head<3>());
  response.wrench.tail<3>() =
      clear(free_rotations_, motion.w_FM_F, response.wrench.tail<3>());
  const Matrix3 RD = motion.R_FM * D_;
  response.dissipation =
      motion.v_FM_F.dot(damper_force) + motion.w_FM_F.dot(damper_moment);
  response.stiffness.topLeftCorner<3, 3>() = p.translational_stiffness;
  response.stiffness.bottomRightCorner<3, 3>() =
      RD.trace() * Matrix3::Identity() - RD;
  response.damping.topLeftCorner<3, 3>() = p.translational_damping;
  response.damping.bottomRightCorner<3, 3>() = p.rotational_damping;
  if (is_coupled_) add_coupling(motion, response);
  return response;
}

// s = vee(R) / 2, ds = S dphi with S = (tr(R) I - R) / 2.
void Bushing::add_coupling(const RelativeMotion& motion,
                           CouplerResponse& response) const {
  const Matrix3& R = motion.R_FM;
  const Matrix3& Kc = parameters_.coupling_stiffness;
  const Matrix3& Cc = parameters_.coupling_damping;
  const Vector3 twice_s = vee(R);
  const Vector3 force = 0.5 * Kc * twice_s;
  const Vector3 y = Kc.transpose() * motion.p_FM_F;
  const Matrix3 S = 0.5 * (R.trace() * Matrix3::Identity() - R);
  const Vector3 damper_force = Cc * motion.w_FM_F;

  response.wrench.head<3>() -= force + damper_force;
  response.wrench.tail<3>() -=
      S.transpose() * y + Cc.transpose() * motion.v_FM_F;
  response.energy += motion.p_FM_F.dot(force);
  response.dissipation += 2.0 * motion.v_FM_F.dot(damper_force);
  response.stiffness.topRightCorner<3, 3>() = Kc * S;
  response.stiffness.bottomLeftCorner<3, 3>() = (Kc * S).transpose();
  response.stiffness.bottomRightCorner<3, 3>() -=
      0.5 * (y * twice_s.transpose() + R.transpose() * skew(y));
  response.damping.topRightCorner<3, 3>() = Cc;
  response.damping.bottomLeftCorner<3, 3>() = Cc.transpose();
}

RequiredSides Bushing::find_required_rotations() const {
  const Matrix3 required = normalised(parameters_.rotational_stiffness) +
                           normalised(parameters_.rotational_damping);
  return {required, required};
}

ConstraintStiffness find_constraint_stiffness(const Bushing& constraint) {
  return {find_largest(constraint.parameters().translational_stiffness),
          find_largest(constraint.parameters().rotational_stiffness)};
}

ConstraintGap find_constraint_gap(const Bushing& constraint,
                                  const RelativeMotion& motion) {
  const Bushing::Parameters& p = constraint.parameters();
  const auto [kt, kr] = find_constraint_stiffness(constraint);
  ConstraintGap gap;
  auto translation = gap.directions.topLeftCorner<3, 3>();
  auto rotation = gap.directions.bottomRightCorner<3, 3>();
  if (kt > 0.0) translation = p.translational_stiffness / kt;
  if (kr > 0.0) rotation = p.rotational_stiffness / kr;
  const Vector6 wrench =
      constraint.evaluate({motion.R_FM, motion.p_FM_F}).wrench;
  if (kt > 0.0) gap.gap.head<3>() = wrench.head<3>() / kt;
  if (kr > 0.0) gap.gap.tail<3>() = wrench.tail<3>() / kr;
  return gap;
}

ConstraintDeflection find_deflection(const Bushing& constraint,
                                     const ConstraintStiffness& stiffness,
                                     const RelativeMotion& motion) {
  const Bushing::Parameters& p = constraint.parameters();
  ConstraintDeflection deflection;
  if (stiffness.translational > 0.0) {
    const Vector3 force = p.translational_stiffness * motion.p_FM_F;
    deflection.distance = force.norm() / stiffness.translational;
  }
  if (stiffness.rotational > 0.0) {
    // theta^2 / 2 of a rotation by small angles.
    const Matrix3 D = find_chordal(p.rotational_stiffness);
    const double energy = (D * (Matrix3::Identity() - motion.R_FM)).trace();
    deflection.rotation =
        std::sqrt(2.0 * std::max(energy, 0.0) / stiffness.rotational);
  }
  return deflection;
}

}  // namespace limber::joints
