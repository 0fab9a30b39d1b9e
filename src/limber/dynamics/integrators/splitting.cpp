// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/splitting.hpp"

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/integrators/finite_check.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {

Splitting::Splitting(const SystemModel& model)
    : model_(model),
      terms_(make_terms(model)),
      kick_(make_unknowns(model)),
      next_(make_state(model)),
      middle_(make_state(model)),
      flows_(make_flows(model)),
      modes_(model) {
  LIMBER_EXPECT(model.nodal_count == 0);
}

void Splitting::drift(SystemState& state) {
  const double half = modes_.time();
  for (BodyState& body : state.bodies) {
    body.p_WB += half * body.v_WB_W;
    body.quat_WB = body.quat_WB * exp_quaternion(half * body.w_WB_B);
    body.quat_WB.normalize();
  }
  modes_.move(state, flows_.dissipated);
}

// At middle_.
void Splitting::calc_kick() {
  calc_terms(model_, middle_, Side::right, terms_);
  solve_accelerations(model_, terms_, kick_);
  modes_.add_own_forces(middle_, kick_);
}

void Splitting::kick(const SystemState& from, double h, SystemState& to) const {
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const BodyModel& body = model_.bodies[b];
    to.bodies[b].v_WB_W =
        from.bodies[b].v_WB_W + h * translation_rows(body, kick_);
    to.bodies[b].w_WB_B =
        from.bodies[b].w_WB_B + h * rotation_rows(body, kick_);
    to.etadot.segment(body.offset, body.modes) =
        from.etadot.segment(body.offset, body.modes) +
        h * mode_rows(body, kick_);
  }
}

StepResult Splitting::step(SystemState& state, double h, double end) {
  const double half = 0.5 * h;
  modes_.set_time(half);
  next_ = state;
  next_.t = end;
  flows_.clear();
  drift(next_);
  middle_ = next_;
  middle_.t = state.t + half;
  calc_kick();
  kick(next_, half, middle_);
  calc_kick();
  kick(next_, h, next_);
  for (BodyTerms& body : terms_.bodies) body.dissipated = 0.0;  // by drifts
  add_powers(terms_, h, flows_);
  drift(next_);
  require_finite(model_, next_, h);
  StepResult result;
  set_work(flows_, result);
  std::swap(state, next_);
  return result;
}

}  // namespace limber::dynamics
