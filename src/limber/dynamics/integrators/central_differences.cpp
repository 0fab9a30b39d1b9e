// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/central_differences.hpp"

#include <utility>

#include "limber/dynamics/equations/motion_fields.hpp"
#include "limber/dynamics/integrators/finite_check.hpp"
#include "limber/dynamics/system/state_increments.hpp"

namespace limber::dynamics {

CentralDifferences::CentralDifferences(const SystemModel& model)
    : model_(model),
      terms_(make_terms(model)),
      v_(make_unknowns(model)),
      a_(v_),
      a_next_(v_),
      work_(v_),
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
  get_velocities(model_, from, v_);
  next_.t = end;
  next_.bodies = from.bodies;
  next_.eta = from.eta;
  next_.u_H = from.u_H;
  work_ = h * v_ + 0.5 * h * h * a_;
  dynamics::displace(model_, work_, 1.0, next_);
  work_ = v_ + h * a_;
  set_velocities(model_, work_, next_);
  maxwell_.set_step(h, terms_);
  maxwell_.advance(from, next_);
}

StepResult CentralDifferences::step(SystemState& state, double h, double end) {
  copy_step_constants(state, next_);
  displace(state, h, end);
  require_finite(model_, next_, h);
  calc_terms(model_, next_, Side::left, terms_);
  solve_accelerations(model_, terms_, a_next_);
  work_ += 0.5 * h * (a_next_ - a_);
  set_velocities(model_, work_, next_);
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
