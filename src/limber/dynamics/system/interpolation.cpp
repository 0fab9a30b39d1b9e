// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/interpolation.hpp"

#include "limber/common/rotation.hpp"

namespace limber::dynamics {
namespace {

// Weights of the end's value and of both ends' rates, and of their derivative.
struct Cubic {
  double value, begin, end;
  double value_rate, begin_rate, end_rate;

  Cubic(double s, double h)
      : value(s * s * (3.0 - 2.0 * s)),
        begin(h * s * (1.0 - s) * (1.0 - s)),
        end(-h * s * s * (1.0 - s)),
        value_rate(6.0 * s * (1.0 - s) / h),
        begin_rate((1.0 - s) * (1.0 - 3.0 * s)),
        end_rate(s * (3.0 * s - 2.0)) {}
};

void interpolate_body(const BodyState& a, const BodyState& b, const Cubic& c,
                      BodyState& out) {
  const Vector3 moved = b.p_WB - a.p_WB;
  out.p_WB = a.p_WB + c.value * moved + c.begin * a.v_WB_W + c.end * b.v_WB_W;
  out.v_WB_W =
      c.value_rate * moved + c.begin_rate * a.v_WB_W + c.end_rate * b.v_WB_W;
  const Vector3 turned = log_rotation(a.quat_WB.conjugate() * b.quat_WB);
  const Vector3 end_rate = right_jacobian_inverse(turned) * b.w_WB_B;
  const Vector3 rotation =
      c.value * turned + c.begin * a.w_WB_B + c.end * end_rate;
  const Vector3 rate =
      c.value_rate * turned + c.begin_rate * a.w_WB_B + c.end_rate * end_rate;
  out.quat_WB = (a.quat_WB * exp_quaternion(rotation)).normalized();
  out.w_WB_B = right_jacobian(rotation) * rate;
}

void interpolate_vectors(const VectorX& a, const VectorX& adot,
                         const VectorX& b, const VectorX& bdot, const Cubic& c,
                         VectorX& out, VectorX& rate) {
  out = a + c.value * (b - a) + c.begin * adot + c.end * bdot;
  rate = c.value_rate * (b - a) + c.begin_rate * adot + c.end_rate * bdot;
}

}  // namespace

void interpolate(const SystemModel& model, const SystemState& begin,
                 const SystemState& end, double fraction, SystemState& state) {
  const double h = end.t - begin.t;
  const Cubic cubic(fraction, h);
  state.t = begin.t + fraction * h;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].has_rigid_motion()) {
      interpolate_body(begin.bodies[b], end.bodies[b], cubic, state.bodies[b]);
    } else {
      state.bodies[b] = end.bodies[b];
    }
  }
  interpolate_vectors(begin.eta, begin.etadot, end.eta, end.etadot, cubic,
                      state.eta, state.etadot);
  interpolate_vectors(begin.u_H, begin.udot_H, end.u_H, end.udot_H, cubic,
                      state.u_H, state.udot_H);
  state.maxwell = begin.maxwell + fraction * (end.maxwell - begin.maxwell);
  state.X_WH = end.X_WH;
  state.memory = begin.memory;
  for (std::size_t c = 0; c < state.memory.size(); ++c) {
    Vector6& wrench = state.memory[c].constraint_wrench;
    wrench += fraction * (end.memory[c].constraint_wrench - wrench);
  }
  // An input's line before its last jump is that of the step, too.
  state.inputs = end.inputs;
  state.controllers = end.controllers;
  state.pair_memory = begin.pair_memory;
  state.far_pairs = begin.far_pairs;
}

}  // namespace limber::dynamics
