// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/stepping/step_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/equations/motion_scale.hpp"
#include "limber/dynamics/system/linked_groups.hpp"
#include "limber/dynamics/system/state_increments.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
namespace {

constexpr double kSafety = 0.8;
constexpr double kWorthGrowing = 1.5;
constexpr double kMostGrowth = 4.0;
constexpr double kMostShrinking = 0.1;
constexpr double kFewestStepsToAMark = 4.0;
// The mean force in a step is then right to 1.3 % of the amplitude, and the
// estimate of a step's error sees the force change.
constexpr double kFewestStepsToAPeriod = 16.0;
constexpr double kMostRotation = 1.0;    // [rad]
constexpr double kSmallFraction = 1e-3;  // of a body's size, for differences

VectorX find_accelerations(const SystemModel& model, const SystemState& state,
                           Side side) {
  SystemTerms terms = make_terms(model);
  calc_terms(model, state, side, terms);
  VectorX a = make_unknowns(model);
  solve_accelerations(model, terms, a);
  return a;
}

// In which no body moves by more than a small fraction of its size.
double find_short_time(const SystemModel& model, const SystemState& state) {
  const std::vector<Vector3> drifts = find_drifts(model, state);
  double fastest = 0.0;  // [1/s]
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyState& at = state.bodies[b];
    const double reach = find_reach(model, static_cast<BodyIndex>(b));
    fastest = std::max(
        fastest, (at.v_WB_W - drifts[b]).norm() / reach + at.w_WB_B.norm());
  }
  return kSmallFraction / fastest;
}

// The state after a time in which the accelerations hardly change.
SystemState continue_motion(const SystemModel& model, const SystemState& state,
                            const VectorX& a, double h) {
  VectorX v = make_unknowns(model);
  get_velocities(model, state, v);
  SystemState later = state;
  set_velocities(model, v + h * a, later);
  later.t += h;
  displace(model, h * v + 0.5 * h * h * a, 1.0, later);
  return later;
}

}  // namespace

StepControl::StepControl(const ErrorBudget& budget, double longest,
                         double refinement,
                         std::vector<Oscillation> oscillations)
    : budget_(budget),
      oscillations_(std::move(oscillations)),
      refinement_(refinement),
      longest_(refinement * longest),
      most_rotation_(refinement * kMostRotation),
      h_(longest_) {}

double StepControl::propose(const SystemState& state, double left) const {
  double h = std::min(h_, longest_);
  for (const BodyState& body : state.bodies) {
    const double spin = body.w_WB_B.norm();
    if (spin * h > most_rotation_) h = most_rotation_ / spin;
  }
  // Two equal steps instead of a full one and a short one.
  if (h >= left) return left;
  return 2.0 * h > left ? 0.5 * left : h;
}

PlannedStep StepControl::plan(const SystemState& state, double from,
                              double mark, double touch) const {
  PlannedStep limit{(mark - from) / kFewestStepsToAMark, StepCause::breakpoint};
  const auto lower = [&](double length, StepCause cause) {
    if (length < limit.length) limit = {length, cause};
  };
  if (const Oscillation* fastest = find_oscillation(state.t, mark)) {
    lower(fastest->period / kFewestStepsToAPeriod, StepCause::oscillation);
  }
  lower(touch, StepCause::impact);
  limit.length *= refinement_;
  const double left = mark - state.t;
  const double proposed = propose(state, left);
  if (limit.length < proposed) return limit;
  if (proposed >= left) return {proposed, StepCause::breakpoint};
  if (proposed < h_) return {proposed, StepCause::rotation};
  return {proposed,
          proposed >= longest_ ? StepCause::given : StepCause::tolerance};
}

// The fastest one from t to the mark.
const Oscillation* StepControl::find_oscillation(double t, double mark) const {
  return find_fastest(oscillations_, 0.5 * (t + mark));
}

std::string StepControl::describe_oscillation(double t, double mark,
                                              double h) const {
  const Oscillation* fastest = find_oscillation(t, mark);
  if (!fastest ||
      h < 0.5 * refinement_ * fastest->period / kFewestStepsToAPeriod) {
    return "";
  }
  return fmt::format("{} has a period of {:.3g} s, which they follow",
                     fastest->name, fastest->period);
}

bool StepControl::accepts(double h, double error) {
  const double allowed = budget_.allowed();
  // NaN propagates through the root and is clamped below.
  const double factor =
      error == 0.0 ? kMostGrowth : std::cbrt(kSafety * allowed / error);
  const bool accepted = error <= allowed;
  if (!accepted) {
    h_ = h * (factor > kMostShrinking ? std::min(factor, 0.9) : kMostShrinking);
  } else if (factor < 1.0) {
    h_ = std::min(h_, h * factor);
  } else if (h >= 0.99 * h_ && !was_rejected_ && factor >= kWorthGrowing) {
    h_ = h * std::min(factor, kMostGrowth);
  }
  if (accepted) budget_.count(h);
  was_rejected_ = !accepted;
  return accepted;
}

double find_first_step(const SystemModel& model, const SystemState& state,
                       double allowed) {
  const MotionScale scale(model);
  const VectorX a = find_accelerations(model, state, Side::right);
  const double size =
      scale.measure_change(make_unknowns(model), a, 1.0, 0.0).displacement;
  const double free = std::sqrt(allowed / size);
  const double h = std::min(find_short_time(model, state), free);
  if (!(h < kInfinity)) return kInfinity;
  const VectorX later = find_accelerations(
      model, continue_motion(model, state, a, h), Side::left);
  const double change = scale.measure_change(a, later, 1.0, 0.0).displacement;
  return std::min(free, std::cbrt(allowed * h / change));
}

}  // namespace limber::dynamics
