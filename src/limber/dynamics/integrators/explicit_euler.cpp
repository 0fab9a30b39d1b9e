// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/explicit_euler.hpp"

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/integrators/finite_check.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {

ExplicitEuler::ExplicitEuler(const SystemModel& model)
    : model_(model),
      terms_(make_terms(model)),
      accelerations_(make_unknowns(model)),
      next_(make_state(model)),
      flows_(make_flows(model)),
      modes_(model) {
  LIMBER_EXPECT(model.nodal_count == 0);
}

StepResult ExplicitEuler::step(SystemState& state, double h, double end) {
  modes_.set_time(h);
  calc_terms(model_, state, Side::right, terms_);
  solve_accelerations(model_, terms_, accelerations_);
  StepResult result;
  flows_.clear();
  add_powers(terms_, h, flows_);
  set_work(flows_, result);
  next_ = state;
  next_.t = end;
  modes_.add_own_forces(state, accelerations_);
  modes_.move(accelerations_, next_);
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    BodyState& body = next_.bodies[b];
    const BodyModel& model = model_.bodies[b];
    const Vector3 a = translation_rows(model, accelerations_);
    const Vector3 dw = rotation_rows(model, accelerations_);
    body.p_WB += h * body.v_WB_W + 0.5 * h * h * a;
    body.v_WB_W += h * a;
    body.quat_WB =
        body.quat_WB * exp_quaternion(h * body.w_WB_B + 0.5 * h * h * dw);
    body.quat_WB.normalize();
    body.w_WB_B += h * dw;
  }
  require_finite(model_, next_, h);
  std::swap(state, next_);
  return result;
}

}  // namespace limber::dynamics
