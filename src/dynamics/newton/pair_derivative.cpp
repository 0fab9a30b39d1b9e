// SPDX-License-Identifier: BSD-3-Clause
#include <span>
#include <vector>

#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/dynamics/newton/body_increment.hpp"
#include "limber/dynamics/newton/residual_derivative.hpp"
#include "limber/dynamics/system/body_model.hpp"
#include "limber/flexbody/model/mode_products.hpp"

/// ResidualDerivative: the terms of pairs.
namespace limber::dynamics {
namespace {

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

ResidualDerivative::PlaceChange ResidualDerivative::change_place(
    BodyIndex b, const joints::PairPlace& place, const Vector3& arm_B,
    const VectorX& x) const {
  PlaceChange change;
  if (b == kWorld) return change;
  const BodyModel& body = model_.bodies[index(b)];
  if (body.full >= 0) {
    const FullModel& full = model_.full_bodies[index(body.full)];
    const Matrix3 R_BH = terms_->full[index(body.full)].frame.R_HB.transpose();
    const double* u = x.data() + first_node_row(model_) + full.first;
    Vector3 moved = Vector3::Zero();
    for (Eigen::Index n = 0; n < full.mesh->node_count(); ++n) {
      const Eigen::Map<const Vector3> d_u(u + 3 * n);
      moved += place.Phi_B.middleCols<3>(3 * n) * (R_BH * d_u);
    }
    change.p = terms_->pairs.bodies[index(b)].R_WB * moved;
    change.v = c_.velocity * change.p;
    return change;
  }
  const BodyIncrement d(body, x);
  const Matrix3& R = terms_->bodies[index(b)].R_WB;
  const Vector3& w = state_->bodies[index(b)].w_WB_B;
  const Vector3 d_w =
      c_.velocity *
      (right_jacobian_inverse(rotation_rows(body, *motion_)) * d.theta);
  Vector3 v_B = w.cross(arm_B);
  Vector3 d_udot = Vector3::Zero();  // by the products' change
  if (body.modes > 0) {
    const double* eta = state_->eta.data() + body.offset;
    const double* etadot = state_->etadot.data() + body.offset;
    change.arm_B = move_by_modes(body, place, eta, d.eta);
    v_B += move_by_modes(body, place, eta, etadot);
    d_udot = move_by_products(body, place, d.eta, etadot);
  }
  change.p = d.p + R * (d.theta.cross(arm_B) + change.arm_B);
  change.v = c_.velocity * d.p +
             R * (d.theta.cross(v_B) + d_w.cross(arm_B) +
                  w.cross(change.arm_B) + c_.velocity * change.arm_B + d_udot);
  return change;
}

void ResidualDerivative::change_force(
    BodyIndex b, const joints::PairPlace& place, const Vector3& arm_B,
    const Vector3& d_arm_B, const Vector3& force, const Vector3& d_force,
    const VectorX& x, VectorX& r) const {
  if (b == kWorld) return;
  const BodyModel& body = model_.bodies[index(b)];
  if (body.full >= 0) {
    const FullModel& full = model_.full_bodies[index(body.full)];
    const Matrix3& R_HB = terms_->full[index(body.full)].frame.R_HB;
    const Vector3 d_force_B =
        terms_->pairs.bodies[index(b)].R_WB.transpose() * d_force;
    double* rows = r.data() + first_node_row(model_) + full.first;
    for (Eigen::Index n = 0; n < full.mesh->node_count(); ++n) {
      if (full.mesh->held[static_cast<std::size_t>(n)] != 0) continue;
      const Vector3 share =
          place.Phi_B.middleCols<3>(3 * n).transpose() * d_force_B;
      Eigen::Map<Vector3>(rows + 3 * n) -= R_HB * share;
    }
    return;
  }
  const BodyIncrement d(body, x);
  const Matrix3 R_BW = terms_->bodies[index(b)].R_WB.transpose();
  const Vector3 force_B = R_BW * force;
  const Vector3 d_force_B = R_BW * d_force - d.theta.cross(force_B);
  const Eigen::Index row = body.row;
  add_modal_residual(body, place, state_->eta.data() + body.offset, d_force_B,
                     r.data() + row + 6);
  if (!body.has_rigid_motion()) return;
  r.segment<3>(row) -= d_force;
  r.segment<3>(row + 3) -= d_arm_B.cross(force_B) + arm_B.cross(d_force_B);
}

// Rotation of arms and axes under a constant force, the dampers' velocities
// minus those in NewtonMatrix, and all motion of unreduced bodies, which
// NewtonMatrix treats as the world.
void ResidualDerivative::change_pairs(const VectorX& x, VectorX& r) const {
  const auto is_full = [this](BodyIndex b) {
    return b != kWorld && model_.bodies[index(b)].full >= 0;
  };
  std::vector<PlaceChange> A;
  std::vector<PlaceChange> B;
  for (std::size_t i = 0; i < model_.pairs.size(); ++i) {
    const Pair& pair = model_.pairs[i];
    const joints::PairResponse& response = terms_->pairs.responses[i];
    const std::span<const joints::PairPoint> points = response.points();
    A.clear();
    B.clear();
    for (const joints::PairPoint& point : points) {
      A.push_back(change_place(pair.body_A, point.on_A, point.acting.A, x));
      B.push_back(change_place(pair.body_B, point.on_B, point.acting.B, x));
    }
    const bool full_A = is_full(pair.body_A);
    const bool full_B = is_full(pair.body_B);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const joints::PairPoint& point = points[k];
      const auto change_by = [&](bool by_full) {
        Vector3 change = Vector3::Zero();
        for (std::size_t j = 0; j < points.size(); ++j) {
          Vector3 moved = Vector3::Zero();
          if (full_B == by_full) moved += B[j].p;
          if (full_A == by_full) moved -= A[j].p;
          if (j == k) {
            change -= (point.stiffness + c_.velocity * point.damping) * moved;
          } else if (response.is_coupled()) {
            change -= (response.coupling(k, j) +
                       c_.velocity * response.damping_coupling(k, j)) *
                      moved;
          }
        }
        return change;
      };
      const auto find_speed = [&](std::size_t j) -> Vector3 {
        return (B[j].v - A[j].v) - c_.velocity * (B[j].p - A[j].p);
      };
      Vector3 by_dampers = -point.damping * find_speed(k);
      for (std::size_t j = 0; response.is_coupled() && j < points.size(); ++j) {
        if (j == k) continue;
        by_dampers -= response.damping_coupling(k, j) * find_speed(j);
      }
      Vector3 d_reduced = by_dampers;
      Vector3 d_full = by_dampers;
      if (full_A || full_B) {
        d_reduced += change_by(true);
        d_full += change_by(true) + change_by(false);
      }
      const Vector3& d_A = full_A ? d_full : d_reduced;
      const Vector3& d_B = full_B ? d_full : d_reduced;
      change_force(pair.body_A, point.on_A, point.acting.A, A[k].arm_B,
                   -point.force_W, -d_A, x, r);
      change_force(pair.body_B, point.on_B, point.acting.B, B[k].arm_B,
                   point.force_W, d_B, x, r);
    }
  }
}

}  // namespace limber::dynamics
