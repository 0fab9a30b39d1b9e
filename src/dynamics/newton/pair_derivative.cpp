// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/newton/body_increment.hpp"
#include "limber/dynamics/newton/residual_derivative.hpp"
#include "limber/dynamics/system/body_model.hpp"

/// What ResidualDerivative has of pairs.
namespace limber::dynamics {

ResidualDerivative::PlaceChange ResidualDerivative::change_place(
    BodyIndex b, const joints::PairPlace& place, const Vector3& arm_B,
    const VectorX& x) const {
  PlaceChange change;
  if (b == kWorld) return change;
  const BodyModel& body = model_.bodies[index(b)];
  const BodyIncrement d(body, index(b), x);
  const Matrix3& R = terms_->bodies[index(b)].R_WB;
  const Vector3& w = state_->bodies[index(b)].w_WB_B;
  const Vector3 d_w =
      c_.velocity *
      (right_jacobian_inverse((*rotation_increments_)[index(b)]) * d.theta);
  Vector3 v_B = w.cross(arm_B);
  if (body.modes > 0) {
    change.arm_B = combine(place.Phi_B, d.eta);
    v_B += combine(place.Phi_B, state_->etadot.data() + body.offset);
  }
  change.p = d.p + R * (d.theta.cross(arm_B) + change.arm_B);
  change.v = c_.velocity * d.p +
             R * (d.theta.cross(v_B) + d_w.cross(arm_B) +
                  w.cross(change.arm_B) + c_.velocity * change.arm_B);
  return change;
}

void ResidualDerivative::change_force(
    BodyIndex b, const joints::PairPlace& place, const Vector3& arm_B,
    const Vector3& d_arm_B, const Vector3& force, const Vector3& d_force,
    const VectorX& x, VectorX& r) const {
  if (b == kWorld) return;
  const BodyModel& body = model_.bodies[index(b)];
  const BodyIncrement d(body, index(b), x);
  const Matrix3 R_BW = terms_->bodies[index(b)].R_WB.transpose();
  const Vector3 force_B = R_BW * force;
  const Vector3 d_force_B = R_BW * d_force - d.theta.cross(force_B);
  const Eigen::Index row = first_row(body, index(b));
  r.segment(row + 6, body.modes) -= place.Phi_B.transpose() * d_force_B;
  if (!body.has_rigid_motion()) return;
  r.segment<3>(row) -= d_force;
  r.segment<3>(row + 3) -= d_arm_B.cross(force_B) + arm_B.cross(d_force_B);
}

// Arms and axes that turn with a constant force, and the dampers' velocities
// less those that NewtonMatrix takes for them.
void ResidualDerivative::change_pairs(const VectorX& x, VectorX& r) const {
  for (std::size_t i = 0; i < model_.pairs.size(); ++i) {
    const Pair& pair = model_.pairs[i];
    for (const joints::PairPoint& point : terms_->pairs.responses[i].points()) {
      const PlaceChange A =
          change_place(pair.body_A, point.on_A, point.acting.A, x);
      const PlaceChange B =
          change_place(pair.body_B, point.on_B, point.acting.B, x);
      const Vector3 d_force =
          -point.damping * ((B.v - A.v) - c_.velocity * (B.p - A.p));
      change_force(pair.body_A, point.on_A, point.acting.A, A.arm_B,
                   -point.force_W, -d_force, x, r);
      change_force(pair.body_B, point.on_B, point.acting.B, B.arm_B,
                   point.force_W, d_force, x, r);
    }
  }
}

}  // namespace limber::dynamics
