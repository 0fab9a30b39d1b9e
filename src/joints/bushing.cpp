// SPDX-License-Identifier: BSD-3-Clause
#include "joints/bushing.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <string>

#include "common/errors.hpp"
#include "common/rotation.hpp"

namespace limber::joints {
namespace {

// Relative slack for symmetry and for eigenvalues that should be zero.
constexpr double kRoundoff = 1e-12;

template <typename Matrix>
void check_semidefinite(const Matrix& m, const std::string& what) {
  if (!m.allFinite()) {
    throw InputError(fmt::format("bushing: {} is not finite", what));
  }
  const double scale = m.cwiseAbs().maxCoeff();
  if ((m - m.transpose()).cwiseAbs().maxCoeff() > kRoundoff * scale) {
    throw InputError(fmt::format("bushing: {} is not symmetric", what));
  }
  const double lowest =
      Eigen::SelfAdjointEigenSolver<Matrix>(m, Eigen::EigenvaluesOnly)
          .eigenvalues()
          .minCoeff();
  if (lowest < -kRoundoff * scale) {
    throw InputError(fmt::format(
        "bushing: {} has a negative eigenvalue {:g}; it would feed energy in",
        what, lowest));
  }
}

// The blocks one by one, then together, each in the unit in which its largest
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

}  // namespace

Bushing::Bushing(const Parameters& parameters) : parameters_(parameters) {
  const Parameters& p = parameters_;
  check_form(p.translational_stiffness, p.rotational_stiffness,
             p.coupling_stiffness, "stiffness");
  check_form(p.translational_damping, p.rotational_damping, p.coupling_damping,
             "damping");
  D_ = 0.5 * p.rotational_stiffness.trace() * Matrix3::Identity() -
       p.rotational_stiffness;
  is_coupled_ =
      !p.coupling_stiffness.isZero(0.0) || !p.coupling_damping.isZero(0.0);
}

CouplerResponse Bushing::evaluate(const RelativeMotion& motion) const {
  const Parameters& p = parameters_;
  const Vector3 spring_force = p.translational_stiffness * motion.p_FM_F;
  const Vector3 damper_force = p.translational_damping * motion.v_FM_F;
  const Vector3 damper_moment = p.rotational_damping * motion.w_FM_F;
  const Matrix3 RD = motion.R_FM * D_;

  CouplerResponse response;
  response.wrench.head<3>() = -spring_force - damper_force;
  response.wrench.tail<3>() = -vee(RD) - damper_moment;
  // tr(D (I - R)) = tr((I - R) D (I - R)') / 2: no cancellation at R = I.
  const Matrix3 gap = Matrix3::Identity() - motion.R_FM;
  response.energy = 0.5 * motion.p_FM_F.dot(spring_force) +
                    0.5 * (gap * D_ * gap.transpose()).trace();
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

}  // namespace limber::joints
