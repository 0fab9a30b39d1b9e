// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/steady_linearisation.hpp"

#include <algorithm>
#include <cmath>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/analysis/group_motion.hpp"
#include "limber/dynamics/system/linked_groups.hpp"

namespace limber::dynamics {
namespace {

/// Largest change from one small motion to another, each term relative to those
/// of its kind in the first at its frequencies and at `spin` [rad/s].
double measure_change(const SmallMotion& a, const SmallMotion& b,
                      const PrincipalBasis& basis, double spin) {
  const MatrixX& Q = basis.Q;
  const MatrixX S = a.project_stiffness(Q);
  const VectorX slow =
      S.diagonal().cwiseAbs().cwiseSqrt().cwiseMax(spin).cwiseInverse();
  const VectorX root = slow.cwiseSqrt();
  const MatrixX dS =
      slow.asDiagonal() * (b.project_stiffness(Q) - S) * slow.asDiagonal();
  const MatrixX dD =
      root.asDiagonal() * (Q.transpose() * (b.D - a.D) * Q) * root.asDiagonal();
  const MatrixX dM = Q.transpose() * (b.M - a.M) * Q;
  return std::max({dS.cwiseAbs().maxCoeff(), dD.cwiseAbs().maxCoeff(),
                   dM.cwiseAbs().maxCoeff()});
}

using Bodies = std::vector<BodyIndex>;

SteadyMotion linearise(const SystemModel& model, const SystemState& state,
                       const Bodies& bodies, const Vector3& w_W,
                       const Vector3& spin_W) {
  SteadyMotion c;
  c.axes.w_W = w_W;
  const auto find = [&](const SystemState& at, const TurningAxes& axes) {
    return take_group(model, find_small_motion(model, at, axes), bodies).motion;
  };
  c.motion = find(state, c.axes);
  c.basis = find_principal_basis(model, c.motion);
  if (spin_W.isZero(0.0)) return c;
  const double time = 1.0 / spin_W.norm();
  const TurningAxes later{exp_rotation(time * w_W), w_W};
  const SystemState then = advance_steadily(model, state, c.axes, time);
  c.change =
      measure_change(c.motion, find(then, later), c.basis, spin_W.norm());
  return c;
}

SteadyMotion linearise(const SystemModel& model, const SystemState& state,
                       const Bodies& bodies) {
  constexpr double kSame = 1e-6;
  const Vector3 spin = find_fastest_spin(state, bodies);
  SteadyMotion still = linearise(model, state, bodies, Vector3::Zero(), spin);
  if (spin.isZero(0.0) || still.change <= kSame) return still;
  SteadyMotion turning = linearise(model, state, bodies, spin, spin);
  return turning.change < still.change ? turning : still;
}

}  // namespace

SteadyMotion linearise_steadily(const SystemModel& model,
                                const SystemState& state) {
  Bodies all;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) all.emplace_back(b);
  return linearise(model, state, all);
}

std::vector<SteadyMotion> linearise_groups(const SystemModel& model,
                                           const SystemState& state) {
  std::vector<SteadyMotion> motions;
  const SmallMotion still = find_small_motion(model, state);
  for (const Bodies& group : find_linked_groups(model)) {
    if (find_fastest_spin(state, group).isZero(0.0)) {
      SteadyMotion& c = motions.emplace_back();
      c.motion = take_group(model, still, group).motion;
      c.basis = find_principal_basis(model, c.motion);
    } else {
      motions.push_back(linearise(model, state, group));
    }
    if (motions.back().motion.size() == 0) motions.pop_back();
  }
  return motions;
}

}  // namespace limber::dynamics
