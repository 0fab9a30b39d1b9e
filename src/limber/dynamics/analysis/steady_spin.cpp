// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/steady_spin.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/dynamics/analysis/group_lengths.hpp"
#include "limber/dynamics/analysis/steady_motion.hpp"
#include "limber/dynamics/analysis/stiff_joints.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/equations/motion_scale.hpp"
#include "limber/dynamics/system/linked_groups.hpp"
#include "limber/dynamics/system/state_increments.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
namespace {

using Eigen::Index;

constexpr double kSame = 1e-9;  // velocities of one rotation
// Of a velocity, relative to the common one.
constexpr double kRounding = 8.0 * std::numeric_limits<double>::epsilon();
constexpr double kTolerance = 1e-12;  // of the extent
constexpr double kFine = 1e-9;        // from here corrections may be round-off
constexpr double kLongest = 0.2;      // largest correction, of the extent
constexpr double kShift = 1e-3;       // of M, in w^2
constexpr double kHeld = 1e-3;        // stiffness over that of M w^2
constexpr int kIterations = 60;

bool is_across(const Vector3& vector, const Vector3& w) {
  return vector.cross(w).norm() > kSame * vector.norm() * w.norm();
}

class Spin {
 public:
  Spin(const SystemModel& model, const SystemState& start)
      : model_(model),
        w_(find_fastest_spin(start)),
        drifts_(find_drifts(model, start)),
        p_0_(start.bodies.front().p_WB),
        v_0_(start.bodies.front().v_WB_W),
        terms_(make_terms(model)),
        accelerations_(make_unknowns(model)),
        lengths_(model, start) {
    check_model();
    check_velocities(start);
    check_loads(start);
  }

  SystemState solve(SystemState state) {
    double last = 0.0;
    for (int i = 0; i < kIterations; ++i) {
      rotate(state);
      const VectorX correction = correct(state);
      const double length = lengths_.measure(correction);
      if (!std::isfinite(length)) break;
      displace(model_, correction, std::min(1.0, kLongest / length), state);
      const bool is_round_off = length < kFine && length > 0.5 * last;
      if (length <= kTolerance || (i > 0 && is_round_off)) {
        rotate(state);
        return state;
      }
      last = length;
    }
    throw NumericalError(fmt::format(
        "no steady rotation at {:.6g} rad/s near the start: Newton's method "
        "ends with a correction of {:.2g} of the system's extent",
        w_.norm(), last));
  }

 private:
  void check_model() const {
    if (!model_.pairs.empty()) {
      throw InputError(
          fmt::format("pair '{}': steady rotation with pairs is not supported",
                      model_.pairs[0].name));
    }
    for (const FullModel& full : model_.full_bodies) {
      throw InputError(
          fmt::format("body '{}': steady rotation is not supported at level "
                      "full; use nonlinear",
                      model_.bodies[static_cast<std::size_t>(full.body)].name));
    }
  }

  [[nodiscard]] Vector3 find_velocity(const Vector3& p) const {
    return v_0_ + w_.cross(p - p_0_);
  }

  void check_velocities(const SystemState& start) const {
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
      const BodyState& at = start.bodies[b];
      const double scale = w_.norm() * ((at.p_WB - p_0_).norm() +
                                        find_reach(model_, BodyIndex(b)));
      const double rounding = kRounding * v_0_.norm();
      const bool rotates =
          (at.quat_WB * at.w_WB_B - w_).norm() <= kSame * w_.norm();
      const bool follows = (at.v_WB_W - find_velocity(at.p_WB)).norm() <=
                           kSame * scale + rounding;
      if (rotates && follows && model_.bodies[b].has_rigid_motion()) continue;
      throw InputError(fmt::format(
          "body '{}' does not rotate with the others at ({:.6g}, {:.6g}, "
          "{:.6g}) rad/s: a moving system is in equilibrium only if all of it "
          "rotates about one axis",
          model_.bodies[b].name, w_.x(), w_.y(), w_.z()));
    }
    if (!start.etadot.isZero(0.0)) {
      throw InputError(
          "modes that move at the start are in no steady rotation; leave their "
          "velocities out");
    }
  }

  void check_loads(const SystemState& start) const {
    if (is_across(model_.gravity_W, w_)) {
      throw InputError(
          "gravity across the axis of rotation: no rotation is steady in it");
    }
    for (const Load& load : model_.loads) {
      if (!load.in_world || evaluate(load.function, now_of(start)) == 0.0 ||
          !(is_across(load.force, w_) || is_across(load.moment, w_))) {
        continue;
      }
      throw InputError(
          "a load in the world's axes across the axis of rotation: no rotation "
          "is steady under it; use frame = \"body\"");
    }
  }

  // Rotation of a group about the axis, as small motion.
  [[nodiscard]] VectorX find_rotation(
      const SmallMotion& motion, const SystemState& state,
      const std::vector<BodyIndex>& group) const {
    VectorX turned = VectorX::Zero(motion.size());
    const Vector3 centre = p_0_ + w_.cross(v_0_) / w_.squaredNorm();
    for (const BodyIndex b : group) {
      const Index place = motion.places[index(b)];
      turned.segment<3>(place) = w_.cross(state.bodies[index(b)].p_WB - centre);
      turned.segment<3>(place + 3) = w_;
    }
    return turned;
  }

  // Rotations of groups about the axis that nothing holds, as columns. Every
  // such angle is steady, except for dampers that do not rotate with the group
  // and brake it, which no angle would balance.
  [[nodiscard]] MatrixX find_free_turns(const SmallMotion& motion,
                                        const SystemState& state) const {
    MatrixX free(motion.size(), 0);
    for (const auto& group : find_linked_groups(model_)) {
      const VectorX turned = find_rotation(motion, state, group);
      const double inertia = turned.dot(motion.M * turned);
      const double held = motion.project_stiffness(turned)(0, 0);
      if (std::abs(held) > kHeld * w_.squaredNorm() * inertia) continue;
      free.conservativeResize(Eigen::NoChange, free.cols() + 1);
      free.rightCols<1>() = turned / std::sqrt(inertia);
    }
    return free;
  }

  // Velocities of the rotation.
  void rotate(SystemState& state) const {
    state.etadot.setZero();
    for (BodyState& at : state.bodies) {
      at.v_WB_W = find_velocity(at.p_WB);
      at.w_WB_B = at.quat_WB.conjugate() * w_;
    }
  }

  VectorX find_residual(const SystemState& state) {
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
      translation_rows(model_.bodies[b], accelerations_) =
          w_.cross(state.bodies[b].v_WB_W - drifts_[b]);
    }
    calc_terms(model_, state, Side::right, terms_);
    VectorX residual = VectorX::Zero(count_unknowns(model_));
    calc_residual(model_, accelerations_, terms_, residual);
    return residual;
  }

  // x of S x + B a = right, B' x = 0; a are the accelerations by which free
  // turns are braked. Scaled to one size: soft modes keep their digits beside
  // stiff couplers.
  static VectorX solve(const MatrixX& S, const MatrixX& B,
                       const VectorX& right) {
    const Index n = S.rows();
    const VectorX scale =
        S.diagonal().cwiseAbs().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    MatrixX bordered = MatrixX::Zero(n + B.cols(), n + B.cols());
    bordered.topLeftCorner(n, n) = scale.asDiagonal() * S * scale.asDiagonal();
    bordered.topRightCorner(n, B.cols()) = scale.asDiagonal() * B;
    bordered.bottomLeftCorner(B.cols(), n) =
        bordered.topRightCorner(n, B.cols()).transpose();
    VectorX sides = VectorX::Zero(n + B.cols());
    sides.head(n) = scale.cwiseProduct(right);
    return scale.cwiseProduct(dense::solve(bordered, sides).head(n));
  }

  VectorX correct(const SystemState& state) {
    const VectorX residual = find_residual(state);
    const SmallMotion motion =
        find_small_motion(model_, state, {Matrix3::Identity(), w_});
    const Index n = motion.size();
    MatrixX S = motion.project_stiffness(MatrixX::Identity(n, n)) +
                kShift * w_.squaredNorm() * motion.M;
    VectorX right(n);
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
      const Index row = model_.bodies[b].row;
      const Index p = motion.places[b];
      right.segment<3>(p) = -residual.segment<3>(row);
      right.segment<3>(p + 3) =
          -(state.bodies[b].quat_WB * Vector3(residual.segment<3>(row + 3)));
      right.segment(motion.modes[b], model_.bodies[b].modes) =
          -residual.segment(row + 6, model_.bodies[b].modes);
    }
    const VectorX x =
        solve(S, motion.M * find_free_turns(motion, state), right);
    VectorX correction = VectorX::Zero(residual.size());
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
      const Index row = model_.bodies[b].row;
      const Index p = motion.places[b];
      correction.segment<3>(row) = x.segment<3>(p);
      correction.segment<3>(row + 3) =
          state.bodies[b].quat_WB.conjugate() * Vector3(x.segment<3>(p + 3));
      correction.segment(row + 6, model_.bodies[b].modes) =
          x.segment(motion.modes[b], model_.bodies[b].modes);
    }
    return correction;
  }

  const SystemModel& model_;
  Vector3 w_;                    // [rad/s]
  std::vector<Vector3> drifts_;  // of each body's free group [m/s]
  Vector3 p_0_;                  // a point of the rotation [m]
  Vector3 v_0_;                  // and its velocity [m/s]
  SystemTerms terms_;
  VectorX accelerations_;
  GroupLengths lengths_;
};

}  // namespace

SystemState find_steady_spin(const SystemModel& model,
                             const SystemState& start) {
  LIMBER_EXPECT(!model.bodies.empty());
  if (const auto stiff = replace_ideal_joints(model)) {
    return solve_without_deflection(model, *stiff,
                                    find_steady_spin(*stiff, start),
                                    [&](const SystemState& from) {
                                      return find_steady_spin(*stiff, from);
                                    });
  }
  if (find_fastest_spin(start).isZero(0.0)) {
    throw InputError(
        "a system that moves without rotation has no steady rotation; leave "
        "the velocities out");
  }
  return Spin(model, start).solve(start);
}

}  // namespace limber::dynamics
