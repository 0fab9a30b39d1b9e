// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <span>

#include "limber/dynamics/bodies/place_change.hpp"
#include "limber/dynamics/bodies/surface_reach.hpp"
#include "limber/dynamics/terms/energy_balance.hpp"
#include "limber/dynamics/terms/system_terms.hpp"
#include "limber/joints/pairs/touching.hpp"

/// Functions that a kind of body provides (body.hpp); a kind that lacks a
/// function does not compile.
namespace limber::dynamics {

enum class UnknownKind {
  translation,  ///< of the body frame, world axes [m]
  rotation,     ///< of the body frame, body axes [rad]
  modes,        ///< [kg^1/2 m]
  nodes,        ///< of all nodes, home frame [m]
};

/// Consecutive unknowns of one body that move (unknowns.hpp).
struct UnknownRange {
  UnknownKind kind = UnknownKind::translation;
  Eigen::Index row = 0;   ///< the first
  Eigen::Index size = 0;  ///< number of them
  /// Factor of the sum of their squares in the body's moment of
  /// mass: its mass, moment of inertia, 1, or three times its mass divided by
  /// the number of nodal unknowns [kg, kg m^2, -, kg].
  double mass = 0.0;
};

/// All of a body's, none where nothing moves.
class UnknownRanges {
 public:
  void add(const UnknownRange& range) {
    if (range.size > 0) ranges_[count_++] = range;
  }
  [[nodiscard]] const UnknownRange* begin() const { return ranges_.data(); }
  [[nodiscard]] const UnknownRange* end() const {
    return ranges_.data() + count_;
  }

 private:
  std::array<UnknownRange, 3> ranges_;
  std::size_t count_ = 0;
};

/// Kinetic energy and momentum of a body, and the force on it, world frame.
struct BodyMomentum {
  double kinetic = 0.0;                ///< [J]
  Vector3 momentum = Vector3::Zero();  ///< [kg m/s]
  Vector3 force = Vector3::Zero();     ///< [N]
};

/// A force and a moment about a point.
struct WrenchSum {
  Vector3 point;                     ///< [m]
  Vector3 force = Vector3::Zero();   ///< [N]
  Vector3 moment = Vector3::Zero();  ///< [N m]

  /// A force `f` [N] at `p` [m] and a moment `m` [N m].
  void add(const Vector3& p, const Vector3& f, const Vector3& m) {
    force += f;
    moment += (p - point).cross(f) + m;
  }
};

/// A force on a body at a place of one of its pairs.
struct PairForce {
  const joints::PairPlace& place;
  Vector3 arm_B;    ///< of the place, from Bo [m]
  Vector3 force_W;  ///< [N]
};

/// A kind is a view of a model's body: made from (model, index of the body).
///
/// Its part of the equations of motion. Each adds to what the body's forces
/// are since reset_forces(); add_wrench() and add_load() need
/// calc_attachment(), pairs' forces set_pair_body().
template <typename Kind>
concept EquationKind = requires(
    const Kind& body, const SystemState& state, SystemTerms& terms,
    const SystemTerms& found, const Attachment& attachment,
    AttachmentMotion& motion, const Vector3& v, const Load& load, double factor,
    const BodyLoad& nodal, Eigen::Index column, ProductTerms& own,
    joints::PairBody& moving, const PairForce& force, const VectorX& x,
    VectorX& r, EnergyBalance& balance, std::span<const SystemState> states,
    Eigen::Ref<MatrixX> nodes) {
  // Terms of its size, of attachments on it, and its coordinates for pairs.
  body.append_terms(terms);
  body.size_attachment(attachment, motion, terms);
  { body.make_products() } -> std::same_as<ProductTerms>;
  // R_WB, inertia and all that depends on the state alone.
  body.calc_inertia(state, terms);
  // Gravity and damping, and their powers.
  body.reset_forces(state, terms);
  // All forces and bias terms zero.
  body.clear_forces(terms);
  body.calc_attachment(attachment, state, terms, motion);
  { body.find_frame(attachment, state) } -> std::same_as<FrameMotion>;
  // A force [N] and a moment [N m] at an attachment, world frame.
  body.add_wrench(attachment, motion, v, v, terms);
  // Loads, `factor` times, and column `column` of nodal ones; their powers.
  body.add_load(load, factor, state, terms);
  body.add_nodal_load(nodal, column, state, terms);
  // Its motion for pairs, which refers to the coordinates of `own` or `state`;
  // with terms, from calc_inertia().
  body.set_pair_body(state, own, moving);
  body.set_pair_body(state, found, own, moving);
  body.add_force(force, terms);
  body.add_force_residual(force, found, r);
  // Once all forces are known: completes them, and the power received.
  body.complete_forces(state, terms);
  // In its rows of all accelerations and residuals.
  body.solve_acceleration(found, r);
  body.calc_residual(x, terms, r);
  { body.find_elastic_energy(state, found) } -> std::same_as<double>;
  // Kinetic energy and momenta.
  body.add_energy(state, terms, balance);
  // Motion of its stored nodes (equations/node_motion.hpp).
  body.deform_nodes(states, nodes);
  body.place_nodes(states, nodes);
};

/// Measures of its state and motion, and derivatives for Newton's method.
template <typename Kind>
concept BodyKind = EquationKind<Kind> &&
    requires(const Kind& body, const SystemState& state,
             const SystemTerms& terms, const VectorX& x, const Vector3& v,
             const joints::PairPlace& place, const joints::TouchReach& points,
             const TangentPoint& at, const PlaceForce& force, WrenchSum& sum,
             SurfaceReach& reach, VectorX& r, Matrix3X& scratch) {
  { body.list_unknowns() } -> std::same_as<UnknownRanges>;
  // Whether it has a block in the dense part of Newton's matrix.
  { body.has_dense_block() } -> std::same_as<bool>;
  // Its mean translation in a motion of all unknowns, world axes, and the mean
  // square of its motion relative to a translation [m^2].
  { body.find_translation(state, x) } -> std::same_as<Vector3>;
  { body.measure_squared(state, x, v) } -> std::same_as<double>;
  // The square of the length whose round-off its places have [m^2].
  { body.find_rounded_square(state) } -> std::same_as<double>;
  // A number that is finite where its state is.
  { body.measure_state(state) } -> std::same_as<double>;
  // `scratch` is the same for one body at all states.
  { body.find_momentum(state, terms, scratch) } -> std::same_as<BodyMomentum>;
  // All forces on it, and a sum of their magnitudes beyond weight and modal
  // forces [N].
  body.add_forces(state, terms, sum);
  { body.sum_nodal_forces(terms) } -> std::same_as<double>;
  // Points of its surface, and their largest speed [m/s].
  body.include(points, reach);
  { body.find_speed(state, reach) } -> std::same_as<double>;
  // Derivatives of a pair's place and of a force there.
  { body.change_place(at, place, v, x) } -> std::same_as<PlaceChange>;
  body.add_force_change(at, place, force, x, r);
};

}  // namespace limber::dynamics
