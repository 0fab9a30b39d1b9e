// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/bodies/modal_body.hpp"

#include <cmath>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/bodies/body_increment.hpp"
#include "limber/dynamics/bodies/modal_forces.hpp"
#include "limber/dynamics/system/body_model.hpp"
#include "limber/dynamics/system/linked_groups.hpp"
#include "limber/flexbody/model/mode_products.hpp"

namespace limber::dynamics {
namespace {

double radius_of_gyration_squared(const BodyModel& body) {
  const double r = radius_of_gyration(body);
  return r * r;
}

// Change of a point's displacement by the products of modes, d_eta at eta.
Vector3 move_by_products(const BodyModel& body, const joints::PairPlace& place,
                         const double* eta, const double* d_eta) {
  Vector3 sum = Vector3::Zero();
  flexbody::for_each_product(
      paired_of(body), [&](Eigen::Index pair, int i, int j, bool is_square) {
        const double change = is_square ? eta[i] * d_eta[i]
                                        : eta[i] * d_eta[j] + eta[j] * d_eta[i];
        sum += change * place.Phi_B.col(body.modes + pair);
      });
  return sum;
}

// The same by the modes and their products.
Vector3 move_by_modes(const BodyModel& body, const joints::PairPlace& place,
                      const double* eta, const double* d_eta) {
  Vector3 sum = move_by_products(body, place, eta, d_eta);
  for (int k = 0; k < body.modes; ++k) sum += d_eta[k] * place.Phi_B.col(k);
  return sum;
}

}  // namespace

UnknownRanges ModalBody::list_unknowns() const {
  UnknownRanges ranges;
  if (body_.has_rigid_motion()) {
    ranges.add({UnknownKind::translation, body_.row, 3, body_.mass});
    ranges.add({UnknownKind::rotation, body_.row + 3, 3,
                body_.mass * radius_of_gyration_squared(body_)});
  }
  ranges.add({UnknownKind::modes, body_.row + 6, body_.modes, 1.0});
  return ranges;
}

Vector3 ModalBody::find_translation(const SystemState& /*state*/,
                                    const VectorX& motion) const {
  return translation_rows(body_, motion);
}

double ModalBody::measure_squared(const SystemState& /*state*/,
                                  const VectorX& motion,
                                  const Vector3& translation) const {
  return mode_rows(body_, motion).squaredNorm() / body_.mass +
         (translation_rows(body_, motion) - translation).squaredNorm() +
         0.5 * body_.J0.trace() / body_.mass *
             rotation_rows(body_, motion).squaredNorm();
}

double ModalBody::find_rounded_square(const SystemState& state) const {
  return radius_of_gyration_squared(body_) +
         state.bodies[b_].p_WB.squaredNorm();
}

double ModalBody::measure_state(const SystemState& state) const {
  return state.bodies[b_].p_WB.squaredNorm() +
         state.bodies[b_].w_WB_B.squaredNorm() +
         state.eta.segment(body_.offset, body_.modes).squaredNorm();
}

BodyMomentum ModalBody::find_momentum(const SystemState& state,
                                      const SystemTerms& terms,
                                      Matrix3X& /*scratch*/) const {
  const BodyState& rigid = state.bodies[b_];
  const BodyTerms& t = terms.bodies[b_];
  const auto etadot = state.etadot.segment(body_.offset, body_.modes);
  BodyMomentum sum;
  sum.kinetic = 0.5 * etadot.squaredNorm();
  if (!body_.has_rigid_motion()) return sum;
  const Vector3& w = rigid.w_WB_B;
  sum.momentum = body_.mass * rigid.v_WB_W;
  sum.force = t.force_W;
  sum.kinetic += 0.5 * sum.momentum.dot(rigid.v_WB_W) +
                 w.dot(0.5 * (t.J * w) + t.H() * etadot);
  return sum;
}

void ModalBody::add_forces(const SystemState& state, const SystemTerms& terms,
                           WrenchSum& sum) const {
  const BodyTerms& t = terms.bodies[b_];
  sum.add(state.bodies[b_].p_WB, t.force_W, t.R_WB * t.moment_B);
}

void ModalBody::include(const joints::TouchReach& points,
                        SurfaceReach& reach) const {
  reach.extent = std::max(reach.extent, points.extent);
  if (points.modes.size() > 0) {
    reach.modes = reach.modes.cwiseMax(points.modes);
  }
}

double ModalBody::find_speed(const SystemState& state,
                             const SurfaceReach& reach) const {
  const BodyState& rigid = state.bodies[b_];
  double extent = reach.extent;
  double speed = rigid.v_WB_W.norm();
  const double* eta = state.eta.data() + body_.offset;
  const double* etadot = state.etadot.data() + body_.offset;
  for (int k = 0; k < body_.modes; ++k) {
    extent += reach.modes[k] * std::abs(eta[k]);
    speed += reach.modes[k] * std::abs(etadot[k]);
  }
  flexbody::for_each_product(
      paired_of(body_), [&](Eigen::Index pair, int i, int j, bool is_square) {
        const double largest = reach.modes[body_.modes + pair];
        extent += (is_square ? 0.5 : 1.0) * largest * std::abs(eta[i] * eta[j]);
        speed += largest *
                 std::abs(is_square ? eta[i] * etadot[i]
                                    : eta[i] * etadot[j] + eta[j] * etadot[i]);
      });
  const double angular_speed = rigid.w_WB_B.norm();
  if (angular_speed > 0.0)
    speed += angular_speed * extent;  // of a plane it is infinite
  return speed;
}

PlaceChange ModalBody::change_place(const TangentPoint& at,
                                    const joints::PairPlace& place,
                                    const Vector3& arm_B,
                                    const VectorX& increments) const {
  PlaceChange change;
  const BodyIncrement d(body_, increments);
  const Matrix3& R = at.terms.bodies[b_].R_WB;
  const Vector3& w = at.state.bodies[b_].w_WB_B;
  const Vector3 d_w =
      at.velocity *
      (right_jacobian_inverse(rotation_rows(body_, at.motion)) * d.theta);
  Vector3 v_B = w.cross(arm_B);
  Vector3 d_udot = Vector3::Zero();  // by the products' change
  if (body_.modes > 0) {
    const double* eta = at.state.eta.data() + body_.offset;
    const double* etadot = at.state.etadot.data() + body_.offset;
    change.arm_B = move_by_modes(body_, place, eta, d.eta);
    v_B += move_by_modes(body_, place, eta, etadot);
    d_udot = move_by_products(body_, place, d.eta, etadot);
  }
  change.p = d.p + R * (d.theta.cross(arm_B) + change.arm_B);
  change.v = at.velocity * d.p +
             R * (d.theta.cross(v_B) + d_w.cross(arm_B) +
                  w.cross(change.arm_B) + at.velocity * change.arm_B + d_udot);
  return change;
}

void ModalBody::add_force_change(const TangentPoint& at,
                                 const joints::PairPlace& place,
                                 const PlaceForce& force,
                                 const VectorX& increments,
                                 VectorX& residual) const {
  const BodyIncrement d(body_, increments);
  const Matrix3 R_BW = at.terms.bodies[b_].R_WB.transpose();
  const Vector3 force_B = R_BW * force.force;
  const Vector3 d_force_B = R_BW * force.d_force - d.theta.cross(force_B);
  add_modal_residual(body_, place, at.state.eta.data() + body_.offset,
                     d_force_B, residual.data() + body_.row + 6);
  if (!body_.has_rigid_motion()) return;
  translation_rows(body_, residual) -= force.d_force;
  rotation_rows(body_, residual) -=
      force.d_arm_B.cross(force_B) + force.arm_B.cross(d_force_B);
}

}  // namespace limber::dynamics
