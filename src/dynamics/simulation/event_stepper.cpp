// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/marcher.hpp"

namespace limber::dynamics {
namespace {

// Steps in a row that end at events, at most.
constexpr int kMostCut = 32;
// Of a step: nearer than this, an event is where the step begins or ends.
constexpr double kSame = 1e-9;

}  // namespace

Marcher::Marcher(const SystemModel& model, const SimulationSettings& settings,
                 std::vector<Event>& events)
    : model_(model), stepper_(model, settings), watch_(model), events_(events) {
  using Kind = joints::AxisCoordinate::Kind;
  for (std::size_t c = 0; c < model.couplers.size(); ++c) {
    const auto& coordinates = joints::coordinates_of(model.couplers[c].law);
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      if (coordinates[i].kind == Kind::angle) angles_.push_back({c, i});
    }
  }
  keeps_before_ = settings.tolerance > 0.0 || !watch_.is_empty();
  is_implicit_ = settings.integrator == IntegratorKind::generalized_alpha ||
                 settings.integrator == IntegratorKind::implicit_euler ||
                 settings.integrator == IntegratorKind::energy_conserving;
}

std::optional<DamperImpulse> Marcher::start(SystemState& state, double h) {
  watch_.start(state, events_);
  std::optional<DamperImpulse> impulse;
  if (is_implicit_) impulse = apply_damper_impulse(model_, h, state);
  if (impulse) {
    totals_.dissipated += impulse->dissipated;
    totals_.load_work += impulse->work;
    watch_.accept(state);
  }
  stepper_.start(state, h);
  if (keeps_before_) before_ = state;  // so that no step allocates
  return impulse;
}

void Marcher::cross_jump(const SystemState& state, double h) {
  stepper_.cross_jump(state, h);
}

void Marcher::add_last() {
  totals_.iterations += last_.iterations;
  totals_.factorizations += last_.factorizations;
  totals_.load_work += last_.load_work;
  totals_.dissipated += last_.dissipated;
}

// A step; the costs of one that was taken back stay in `last_`.
void Marcher::advance(SystemState& state, double h, double end) {
  StepResult next = stepper_.step(state, h, end);
  next.iterations += last_.iterations;
  next.factorizations += last_.factorizations;
  last_ = next;
  for (const Angle& angle : angles_) {
    double& near = state.memory[angle.coupler].near[angle.coordinate];
    const auto& law = model_.couplers[angle.coupler].law;
    near = joints::find_position(
        joints::coordinates_of(law)[angle.coordinate],
        stepper_.terms().couplers[angle.coupler].motion, near);
  }
}

void Marcher::attempt(SystemState& state, double h, double end) {
  if (keeps_before_) before_ = state;
  last_ = {};
  h_ = h;
  advance(state, h, end);
}

void Marcher::take_back(SystemState& state) {
  state = before_;
  stepper_.undo(state);
}

void Marcher::pass(const EventWatch::Crossing& crossing, SystemState& state,
                   double h) {
  const EventWatch::Change change = watch_.pass(crossing.index, state, events_);
  totals_.dissipated += change.energy_lost;
  if (change.has_jump) stepper_.start(state, h);
  watch_.accept(state);
}

void Marcher::pass_all_at_end(SystemState& state, double h) {
  while (const auto crossing = watch_.find_first(state, h)) {
    pass(*crossing, state, h);
  }
  watch_.accept();
}

void Marcher::settle(SystemState& state, double nominal_h) {
  if (watch_.is_empty()) {
    add_last();
    return;
  }
  const auto crossing = watch_.find_first(state, h_);
  if (!crossing || crossing->share > 1.0 - kSame || cut_ == kMostCut) {
    cut_ = 0;
    add_last();
    pass_all_at_end(state, nominal_h);
    return;
  }
  ++cut_;
  take_back(state);
  if (crossing->share > kSame) {
    const double until = crossing->share * h_;
    advance(state, until, state.t + until);
  } else {
    last_.load_work = last_.dissipated = 0.0;
  }
  add_last();
  pass(*crossing, state, nominal_h);
}

void Marcher::exchange_memory(Archive& archive, const SystemState& state) {
  stepper_.exchange_memory(archive, state);
  watch_.exchange_memory(archive);
  archive(cut_, totals_.iterations, totals_.factorizations, totals_.load_work,
          totals_.dissipated);
  if (keeps_before_) before_ = state;
}

}  // namespace limber::dynamics
