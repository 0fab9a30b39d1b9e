// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/effective_mass.hpp"

#include "limber/common/errors.hpp"

namespace limber::contact {

void NormalLoad::add(const joints::PairBodies& bodies, const Vector3& p_W,
                     const Vector3& added_W) {
  force_W += added_W;
  moment_A += (p_W - bodies.A.p_WB).cross(added_W);
  moment_B += (p_W - bodies.B.p_WB).cross(added_W);
}

FreeBody::FreeBody(double mass, const Matrix3& inertia_B)
    : inverse_mass_(1.0 / mass), inverse_inertia_B_(Matrix3::Zero()) {
  LIMBER_EXPECT(mass > 0.0);
  if (inertia_B.isZero(0.0)) return;
  LIMBER_EXPECT(inertia_B.determinant() > 0.0);
  inverse_inertia_B_ = inertia_B.inverse();
}

double FreeBody::find_yield(const Matrix3& R_WB, const Vector3& force_W,
                            const Vector3& moment_W) const {
  const Vector3 moment_B = R_WB.transpose() * moment_W;
  return inverse_mass_ * force_W.squaredNorm() +
         moment_B.dot(inverse_inertia_B_ * moment_B);
}

double find_inverse_mass(const FreeBody& A, const FreeBody& B,
                         const joints::PairBodies& bodies,
                         const NormalLoad& load, double F) {
  const Vector3 force_W = load.force_W / F;
  return A.find_yield(bodies.A.R_WB, force_W, load.moment_A / F) +
         B.find_yield(bodies.B.R_WB, force_W, load.moment_B / F);
}

double find_inverse_mass(const joints::PairMobility& Y,
                         const joints::PairBodies& bodies,
                         const NormalLoad& load, double F) {
  const Matrix3 R_AW = bodies.A.R_WB.transpose();
  const Matrix3 R_BW = bodies.B.R_WB.transpose();
  Eigen::Matrix<double, 12, 1> g;
  g << -(R_AW * load.force_W), -(R_AW * load.moment_A), R_BW * load.force_W,
      R_BW * load.moment_B;
  return g.dot(Y * g) / (F * F);
}

}  // namespace limber::contact
