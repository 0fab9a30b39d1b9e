// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/steady_motion.hpp"

#include <algorithm>
#include <cmath>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/newton/force_balance.hpp"
#include "limber/dynamics/newton/newton_measures.hpp"

namespace limber::dynamics {
namespace {

double sum_forces(const SystemModel& model, const SystemState& state,
                  const SystemTerms& terms) {
  double sum = 0.0;
  for (const BodyModel& body : model.bodies) {
    sum += body.mass * model.gravity_W.norm();
  }
  for (const Load& load : model.loads) {
    const double factor = evaluate(load.function, now_of(state));
    sum += std::abs(factor) * load.force.norm();
  }
  for (const CouplerTerms& c : terms.couplers) {
    sum += c.applied.head<3>().norm();
  }
  for (const BodyTerms& body : terms.bodies) sum += body.force_W.norm();
  return sum;
}

// Force of couplers due to round-off of positions.
double find_noise(const SystemModel& model, const SystemTerms& terms) {
  std::vector<Vector6> gaps;
  find_roundoff_gaps(model, terms, 0.0, gaps);
  double noise = 0.0;
  for (const Vector6& gap : gaps) noise = std::max(noise, gap.norm());
  return noise;
}

void note(double size, const std::string& body, double& largest,
          std::string& where) {
  if (!(size > largest)) return;
  largest = size;
  where = body;
}

}  // namespace

Vector3 find_drift(const SystemModel& model, const SystemState& state) {
  std::size_t free = 0;
  for (const auto& group : find_free_groups(model)) free += group.size();
  Vector3 drift = Vector3::Zero();
  if (free < model.bodies.size()) return drift;
  double mass = 0.0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    drift += model.bodies[b].mass * state.bodies[b].v_WB_W;
    mass += model.bodies[b].mass;
  }
  return drift / mass;
}

bool moves(const SystemState& state) {
  return !state.etadot.isZero(0.0) || !state.udot_H.isZero(0.0) ||
         std::any_of(state.bodies.begin(), state.bodies.end(),
                     [](const BodyState& b) {
                       return !b.v_WB_W.isZero(0.0) || !b.w_WB_B.isZero(0.0);
                     });
}

Imbalance find_imbalance(const SystemModel& model, const SystemState& state,
                         const TurningAxes& axes) {
  constexpr double kBalanced = 1e-6;  // of the acting forces
  constexpr double kSafety = 100.0;   // of round-off
  SystemTerms terms = make_terms(model);
  calc_terms(model, state, Side::right, terms);
  Accelerations a = make_accelerations(model);
  solve_accelerations(model, terms, a);
  const Vector3 drift = find_drift(model, state);
  Imbalance out;
  out.acting = sum_forces(model, state, terms);
  double reach = 0.0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    const auto modes = a.etaddot.segment(body.offset, body.modes);
    note(std::sqrt(body.mass) * modes.norm(), body.name, out.force,
         out.force_body);
    if (!body.has_rigid_motion()) continue;
    const BodyState& at = state.bodies[b];
    const Vector3 steady = axes.w_W.cross(at.v_WB_W - drift);
    const double force = body.mass * (a.a_WB_W[b] - steady).norm();
    out.acting += body.mass * steady.norm();
    const Vector3 w = terms.bodies[b].R_WB.transpose() * axes.w_W;
    const double moment =
        (terms.bodies[b].J * (a.dw_WB_B[b] - w.cross(at.w_WB_B))).norm();
    note(force, body.name, out.force, out.force_body);
    note(moment, body.name, out.moment, out.moment_body);
    reach = std::max(reach, std::sqrt(0.5 * body.J0.trace() / body.mass));
  }
  const double limit =
      kBalanced * out.acting + kSafety * find_noise(model, terms);
  out.matters = out.force > limit || out.moment > limit * reach;
  return out;
}

SystemState advance_steadily(const SystemModel& model, const SystemState& state,
                             const TurningAxes& axes, double time) {
  const Vector3 drift = find_drift(model, state);
  const Vector3 turn = time * axes.w_W;
  const Matrix3 R = exp_rotation(turn);
  SystemState later = state;
  for (BodyState& body : later.bodies) {
    const Vector3 v = body.v_WB_W - drift;
    const Vector3 w = body.quat_WB * body.w_WB_B;
    body.p_WB += time * (drift + left_jacobian(turn) * v);
    body.v_WB_W = drift + R * v;
    const Quaternion q = exp_quaternion(turn) *
                         exp_quaternion(time * (w - axes.w_W)) * body.quat_WB;
    body.quat_WB = q.normalized();
    body.w_WB_B = body.quat_WB.conjugate() * (R * w);
  }
  return later;
}

Vector3 find_fastest_spin(const SystemState& state) {
  Vector3 fastest = Vector3::Zero();
  for (const BodyState& body : state.bodies) {
    const Vector3 w = body.quat_WB * body.w_WB_B;
    if (w.norm() > fastest.norm()) fastest = w;
  }
  return fastest;
}

}  // namespace limber::dynamics
