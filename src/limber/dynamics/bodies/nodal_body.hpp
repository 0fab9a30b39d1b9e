// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include "limber/common/errors.hpp"
#include "limber/dynamics/bodies/body_kind.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {

/// Runs `work`; prefixes a NumericalError of the mesh with the body's name and
/// the time [s].
template <typename Work>
auto name_failures(const BodyModel& body, double t, const Work& work) {
  try {
    return work();
  } catch (const NumericalError& error) {
    throw NumericalError(fmt::format("body '{}' at t = {:.9g} s: {}", body.name,
                                     t, error.what()));
  }
}

/// An unreduced body: its unknowns are the displacements of its nodes (level
/// `full`). Its functions: body_kind.hpp.
class NodalBody {
 public:
  NodalBody(const SystemModel& model, std::size_t body)
      : model_(model), body_(model.bodies[body]), b_(body) {}

  void append_terms(SystemTerms& terms) const;
  void size_attachment(const Attachment& attachment, AttachmentMotion& motion,
                       SystemTerms& terms) const;
  [[nodiscard]] ProductTerms make_products() const;
  void calc_inertia(const SystemState& state, SystemTerms& terms) const;
  void reset_forces(const SystemState& state, SystemTerms& terms) const;
  void clear_forces(SystemTerms& terms) const;
  void calc_attachment(const Attachment& attachment, const SystemState& state,
                       SystemTerms& terms, AttachmentMotion& motion) const;
  [[nodiscard]] FrameMotion find_frame(const Attachment& attachment,
                                       const SystemState& state) const;
  void add_wrench(const Attachment& attachment, AttachmentMotion& motion,
                  const Vector3& force_W, const Vector3& moment_W,
                  SystemTerms& terms) const;
  void add_load(const Load& load, double factor, const SystemState& state,
                SystemTerms& terms) const;
  void add_nodal_load(const BodyLoad& load, Eigen::Index i,
                      const SystemState& state, SystemTerms& terms) const;
  void set_pair_body(const SystemState& state, ProductTerms& own,
                     joints::PairBody& out) const;
  void set_pair_body(const SystemState& state, const SystemTerms& terms,
                     ProductTerms& own, joints::PairBody& out) const;
  void add_force(const PairForce& force, SystemTerms& terms) const;
  void add_force_residual(const PairForce& force, const SystemTerms& terms,
                          VectorX& residual) const;
  void complete_forces(const SystemState& state, SystemTerms& terms) const;
  void solve_acceleration(const SystemTerms& terms,
                          VectorX& accelerations) const;
  void calc_residual(const VectorX& acceleration, SystemTerms& terms,
                     VectorX& residual) const;
  [[nodiscard]] double find_elastic_energy(const SystemState& state,
                                           const SystemTerms& terms) const;
  void add_energy(const SystemState& state, SystemTerms& terms,
                  EnergyBalance& balance) const;

  void deform_nodes(std::span<const SystemState> states,
                    Eigen::Ref<MatrixX> u_B) const;
  void place_nodes(std::span<const SystemState> states,
                   Eigen::Ref<MatrixX> p_WP) const;

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
  void set_pair_body(const SystemState& state, const MeanFrame& frame,
                     ProductTerms& own, joints::PairBody& out) const;

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
