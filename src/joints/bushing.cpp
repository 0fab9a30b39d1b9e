// SPDX-License-Identifier: BSD-3-Clause
#include "joints/bushing.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>

#include "common/errors.hpp"

namespace limber::joints {
namespace {

// Relative slack for symmetry and for eigenvalues that should be zero.
constexpr double kRoundoff = 1e-12;

void check_semidefinite(const Matrix3& m, const char* what) {
  if (!m.allFinite()) {
    throw InputError(fmt::format("bushing: {} is not finite", what));
  }
  const double scale = m.cwiseAbs().maxCoeff();
  if ((m - m.transpose()).cwiseAbs().maxCoeff() > kRoundoff * scale) {
    throw InputError(fmt::format("bushing: {} is not symmetric", what));
  }
  const double lowest =
      Eigen::SelfAdjointEigenSolver<Matrix3>(m, Eigen::EigenvaluesOnly)
          .eigenvalues()
          .minCoeff();
  if (lowest < -kRoundoff * scale) {
    throw InputError(fmt::format(
        "bushing: {} has a negative eigenvalue {:g}; it would feed energy in",
        what, lowest));
  }
}

// (A32 - A23, A13 - A31, A21 - A12).
Vector3 vee(const Matrix3& A) {
  return {A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1)};
}

}  // namespace

Bushing::Bushing(const Parameters& parameters) : parameters_(parameters) {
  const Parameters& p = parameters_;
  check_semidefinite(p.translational_stiffness, "translational stiffness");
  check_semidefinite(p.rotational_stiffness, "rotational stiffness");
  check_semidefinite(p.translational_damping, "translational damping");
  check_semidefinite(p.rotational_damping, "rotational damping");
  D_ = 0.5 * p.rotational_stiffness.trace() * Matrix3::Identity() -
       p.rotational_stiffness;
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
  return response;
}

}  // namespace limber::joints
