// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/bodies/body_kind.hpp"

namespace limber::dynamics {

/// A body whose frame moves and that deforms in modes, none if it is rigid:
/// every level but `full`. Its functions: body_kind.hpp.
class ModalBody {
 public:
  ModalBody(const SystemModel& model, std::size_t body)
      : body_(model.bodies[body]), b_(body) {}

  [[nodiscard]] UnknownRanges list_unknowns() const;
  [[nodiscard]] bool has_dense_block() const { return true; }
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
  [[nodiscard]] double sum_nodal_forces(const SystemTerms&) const {
    return 0.0;
  }
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
  const BodyModel& body_;
  std::size_t b_;
};

}  // namespace limber::dynamics
