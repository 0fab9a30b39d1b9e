// SPDX-License-Identifier: BSD-3-Clause
#include <span>
#include <vector>

#include "limber/common/index.hpp"
#include "limber/dynamics/bodies/body.hpp"
#include "limber/dynamics/newton/residual_derivative.hpp"

/// ResidualDerivative: the terms of pairs.
namespace limber::dynamics {

// Rotation of arms and axes under a constant force, the dampers' velocities
// minus those in NewtonMatrix, and all motion of unreduced bodies, which
// NewtonMatrix treats as the world.
void ResidualDerivative::change_pairs(const VectorX& x, VectorX& r) const {
  // Whether NewtonMatrix has none of its motion.
  const auto is_left_out = [this](BodyIndex b) {
    return b != kWorld && !has_dense_block(model_, index(b));
  };
  const TangentPoint at{*state_, *terms_, *motion_, c_.velocity};
  const auto change_place = [&](BodyIndex b, const joints::PairPlace& place,
                                const Vector3& arm_B) {
    if (b == kWorld) return PlaceChange{};
    return visit_body(model_, index(b), [&](const auto& body) {
      return body.change_place(at, place, arm_B, x);
    });
  };
  const auto change_force = [&](BodyIndex b, const joints::PairPlace& place,
                                const PlaceForce& force) {
    if (b == kWorld) return;
    visit_body(model_, index(b), [&](const auto& body) {
      body.add_force_change(at, place, force, x, r);
    });
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
      A.push_back(change_place(pair.body_A, point.on_A, point.acting.A));
      B.push_back(change_place(pair.body_B, point.on_B, point.acting.B));
    }
    const bool is_A_left_out = is_left_out(pair.body_A);
    const bool is_B_left_out = is_left_out(pair.body_B);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const joints::PairPoint& point = points[k];
      const auto change_by = [&](bool by_left_out) {
        Vector3 change = Vector3::Zero();
        for (std::size_t j = 0; j < points.size(); ++j) {
          Vector3 moved = Vector3::Zero();
          if (is_B_left_out == by_left_out) moved += B[j].p;
          if (is_A_left_out == by_left_out) moved -= A[j].p;
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
      Vector3 d_kept = by_dampers;
      Vector3 d_left_out = by_dampers;
      if (is_A_left_out || is_B_left_out) {
        d_kept += change_by(true);
        d_left_out += change_by(true) + change_by(false);
      }
      const Vector3& d_A = is_A_left_out ? d_left_out : d_kept;
      const Vector3& d_B = is_B_left_out ? d_left_out : d_kept;
      change_force(pair.body_A, point.on_A,
                   {point.acting.A, A[k].arm_B, -point.force_W, -d_A});
      change_force(pair.body_B, point.on_B,
                   {point.acting.B, B[k].arm_B, point.force_W, d_B});
    }
  }
}

}  // namespace limber::dynamics
