// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/steady_linearisation.hpp"

#include <algorithm>
#include <cmath>

#include "limber/common/rotation.hpp"

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

SteadyMotion linearise(const SystemModel& model, const SystemState& state,
                       const Vector3& w_W, const Vector3& spin_W) {
  SteadyMotion c;
  c.axes.w_W = w_W;
  c.motion = find_small_motion(model, state, c.axes);
  c.basis = find_principal_basis(model, c.motion);
  if (spin_W.isZero(0.0)) return c;
  const double time = 1.0 / spin_W.norm();
  const TurningAxes later{exp_rotation(time * w_W), w_W};
  const SystemState then = advance_steadily(model, state, c.axes, time);
  c.change = measure_change(c.motion, find_small_motion(model, then, later),
                            c.basis, spin_W.norm());
  return c;
}

}  // namespace

SteadyMotion linearise_steadily(const SystemModel& model,
                                const SystemState& state) {
  constexpr double kSame = 1e-6;
  const Vector3 spin = find_fastest_spin(state);
  SteadyMotion still = linearise(model, state, Vector3::Zero(), spin);
  if (spin.isZero(0.0) || still.change <= kSame) return still;
  SteadyMotion turning = linearise(model, state, spin, spin);
  return turning.change < still.change ? turning : still;
}

}  // namespace limber::dynamics
