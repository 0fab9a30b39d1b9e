// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/central_differences.hpp"

#include <utility>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/motion_fields.hpp"
#include "limber/dynamics/integrators/finite_check.hpp"

namespace limber::dynamics {

CentralDifferences::CentralDifferences(const SystemModel& model)
    : model_(model),
      terms_(make_terms(model)),
      a_(make_accelerations(model)),
      a_next_(make_accelerations(model)),
      power_(make_flows(model)),
      flows_(power_),
      next_(make_state(model)),
      maxwell_(model, flexbody::set_linear_step) {}

void CentralDifferences::start(const SystemState& state, double /*h*/) {
  next_ = state;
  calc_terms(model_, state, Side::right, terms_);
  solve_accelerations(model_, terms_, a_);
  power_.clear();
  add_powers(terms_, 1.0, power_);
}

void CentralDifferences::exchange_memory(Archive& archive,
                                         const SystemState& state) {
  archive(a_, power_);
  if (archive.reads()) next_ = state;
}

// Positions at the step's end, and velocities there predicted with unchanged
// accelerations.
void CentralDifferences::displace(const SystemState& from, double h,
                                  double end) {
  const double half = 0.5 * h * h;
  next_.t = end;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const BodyState& old = from.bodies[b];
    BodyState& body = next_.bodies[b];
    body = old;
    if (!model_.bodies[b].has_rigid_motion()) continue;
    body.p_WB += h * old.v_WB_W + half * a_.a_WB_W[b];
    body.quat_WB =
        old.quat_WB * exp_quaternion(h * old.w_WB_B + half * a_.dw_WB_B[b]);
    body.quat_WB.normalize();
    body.v_WB_W += h * a_.a_WB_W[b];
    body.w_WB_B += h * a_.dw_WB_B[b];
  }
  next_.eta = from.eta + h * from.etadot + half * a_.etaddot;
  next_.etadot = from.etadot + h * a_.etaddot;
  maxwell_.set_step(h, terms_);
  maxwell_.advance(from, next_);
  next_.u_H = from.u_H + h * from.udot_H + half * a_.uddot_H;
  next_.udot_H = from.udot_H + h * a_.uddot_H;
}

StepResult CentralDifferences::step(SystemState& state, double h, double end) {
  copy_step_constants(state, next_);
  displace(state, h, end);
  require_finite(model_, next_, h);
  calc_terms(model_, next_, Side::left, terms_);
  solve_accelerations(model_, terms_, a_next_);
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    next_.bodies[b].v_WB_W += 0.5 * h * (a_next_.a_WB_W[b] - a_.a_WB_W[b]);
    next_.bodies[b].w_WB_B += 0.5 * h * (a_next_.dw_WB_B[b] - a_.dw_WB_B[b]);
  }
  next_.etadot += 0.5 * h * (a_next_.etaddot - a_.etaddot);
  next_.udot_H += 0.5 * h * (a_next_.uddot_H - a_.uddot_H);
  StepResult result;
  flows_ = power_;
  flows_ *= 0.5 * h;
  add_powers(terms_, 0.5 * h, flows_);
  set_work(flows_, result);
  power_.clear();
  add_powers(terms_, 1.0, power_);
  std::swap(a_, a_next_);
  std::swap(state, next_);
  return result;
}

}  // namespace limber::dynamics
