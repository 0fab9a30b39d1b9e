// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/marcher.hpp"

namespace limber::dynamics {
namespace {

// Parts of a step that end at events, at most; what happens after them is
// noted at the step's end.
constexpr int kMostParts = 32;
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
}

void Marcher::start(SystemState& state, double h) {
  watch_.start(state, events_);
  stepper_.start(state, h);
  if (!watch_.is_empty()) before_ = state;  // so that no step allocates
}

void Marcher::cross_jump(const SystemState& state, double h) {
  stepper_.cross_jump(state, h);
}

void Marcher::add(const StepResult& result) {
  totals_.iterations += result.iterations;
  totals_.factorizations += result.factorizations;
  totals_.load_work += result.load_work;
  totals_.dissipated += result.dissipated;
}

// A step; the costs of steps that were taken back stay in `result`.
void Marcher::advance(SystemState& state, double h, double end,
                      StepResult& result) {
  StepResult next = stepper_.step(state, h, end);
  next.iterations += result.iterations;
  next.factorizations += result.factorizations;
  result = next;
  for (const Angle& angle : angles_) {
    double& near = state.memory[angle.coupler].near[angle.coordinate];
    const auto& law = model_.couplers[angle.coupler].law;
    near = joints::find_position(
        joints::coordinates_of(law)[angle.coordinate],
        stepper_.terms().couplers[angle.coupler].motion, near);
  }
}

void Marcher::go_back(SystemState& state) {
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

void Marcher::step(SystemState& state, double h, double end) {
  if (watch_.is_empty()) {
    StepResult result;
    advance(state, h, end, result);
    add(result);
    return;
  }
  double left = h;
  for (int part = 0; part < kMostParts; ++part) {
    before_ = state;
    StepResult result;
    advance(state, left, end, result);
    const auto crossing = watch_.find_first(state, left);
    if (!crossing || crossing->share > 1.0 - kSame) {
      add(result);
      pass_all_at_end(state, h);
      return;
    }
    go_back(state);
    if (crossing->share > kSame) {
      const double until = crossing->share * left;
      advance(state, until, state.t + until, result);
    } else {
      result.load_work = result.dissipated = 0.0;
    }
    add(result);
    pass(*crossing, state, h);
    left = end - state.t;
    if (left <= kSame * h) {
      state.t = end;
      return;
    }
  }
  StepResult result;
  advance(state, left, end, result);
  add(result);
  pass_all_at_end(state, h);
}

}  // namespace limber::dynamics
