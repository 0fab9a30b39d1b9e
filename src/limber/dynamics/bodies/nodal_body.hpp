// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/bodies/body_kind.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {

/// An unreduced body: its unknowns are the displacements of its nodes (level
/// `full`). Its functions: body_kind.hpp.
class NodalBody {
 public:
  NodalBody(const SystemModel& model, std::size_t body)
      : model_(model), body_(model.bodies[body]), b_(body) {}

  [[nodiscard]] UnknownRanges list_unknowns() const;
  [[nodiscard]] bool has_dense_block() const { return false; }
  [[nodiscard]] Vector3 find_translation(const SystemState& state,
                                         const VectorX& motion) const;
  [[nodiscard]] double measure_squared(const SystemState& state,
                                       const VectorX& motion,
                                       const Vector3& translation) const;
  [[nodiscard]] double find_rounded_square(const SystemState& state) const;
  [[nodiscard]] double measure_state(const SystemState& state) const;
  [[nodiscard]] BodyMomentum find_momentum(const SystemState& state,
                                           const SystemTerms& terms,
                                           Matrix3X& scratch) const;
  void add_forces(const SystemState& state, const SystemTerms& terms,
                  WrenchSum& sum) const;
  [[nodiscard]] double sum_nodal_forces(const SystemTerms& terms) const;
  void include(const joints::TouchReach& points, SurfaceReach& reach) const;
  [[nodiscard]] double find_speed(const SystemState& state,
                                  const SurfaceReach& reach) const;
  [[nodiscard]] PlaceChange change_place(const TangentPoint& at,
                                         const joints::PairPlace& place,
                                         const Vector3& arm_B,
                                         const VectorX& increments) const;
  void add_force_change(const TangentPoint& at, const joints::PairPlace& place,
                        const PlaceForce& force, const VectorX& increments,
                        VectorX& residual) const;

 private:
  [[nodiscard]] std::size_t f() const {
    return static_cast<std::size_t>(body_.full);
  }
  [[nodiscard]] const FullModel& full() const {
    return model_.full_bodies[f()];
  }
  [[nodiscard]] Eigen::Index first_row() const {
    return first_node_row(model_) + full().first;
  }

  const SystemModel& model_;
  const BodyModel& body_;
  std::size_t b_;
};

}  // namespace limber::dynamics
