// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/stepping/turn_counter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limber/common/index.hpp"

namespace limber::dynamics {
namespace {

constexpr double kHalfTurn = std::numbers::pi;  // [rad]
// Rotation in a step from which on its rate is asked for [rad].
constexpr double kFar = 1.0;

bool is_in_transmission(const SystemModel& model, CouplerIndex coupler) {
  return std::ranges::any_of(model.transmissions, [&](const Transmission& t) {
    const auto* sum = std::get_if<JointSum>(&t.coordinate);
    return sum != nullptr &&
           std::ranges::any_of(sum->terms, [&](const JointSum::Term& term) {
             return term.coupler == coupler;
           });
  });
}

}  // namespace

TurnCounter::TurnCounter(const SystemModel& model, bool by_rate)
    : model_(model), by_rate_(by_rate) {
  using Kind = joints::AxisCoordinate::Kind;
  for (CouplerIndex c(0); c < std::ssize(model.couplers); ++c) {
    const auto& coordinates =
        joints::coordinates_of(model.couplers[index(c)].law);
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      if (coordinates[i].kind != Kind::angle) continue;
      angles_.push_back({c, i, is_in_transmission(model, c)});
    }
  }
}

bool TurnCounter::may_turn_far(const SystemState& state, double h) const {
  return by_rate_ && !angles_.empty() &&
         std::ranges::any_of(state.bodies, [h](const BodyState& body) {
           return body.w_WB_B.norm() * h > 0.5 * kFar;
         });
}

std::optional<std::string> TurnCounter::count(const SystemTerms& terms,
                                              double h,
                                              SystemState& state) const {
  for (const Angle& angle : angles_) {
    const Coupler& coupler = model_.couplers[index(angle.coupler)];
    const joints::AxisCoordinate& coordinate =
        joints::coordinates_of(coupler.law)[angle.coordinate];
    const joints::RelativeMotion& motion =
        terms.couplers[index(angle.coupler)].motion;
    double& near = state.memory[index(angle.coupler)].near[angle.coordinate];
    const double nearest = joints::find_position(coordinate, motion, near);
    if (!by_rate_ || !(motion.w_FM_F.norm() * h > kFar)) {
      near = nearest;
      continue;
    }
    // The terms of some schemes are those of the step's begin.
    const joints::RelativeMotion end =
        find_relative_motion(model_, state, angle.coupler);
    const double rate = joints::evaluate(coordinate, end, near).rate;
    const double counted =
        joints::find_position(coordinate, end, near + h * rate);
    if (std::abs(counted - nearest) > kHalfTurn &&
        depends_on_turns(angle, counted, terms, state)) {
      return fmt::format(
          "joint '{}' at t = {:.9g} s: a step of {:.3g} s rotates it by {:.3g} "
          "rad, and what acts along it, such as a spring or a stop, needs less "
          "than half a turn",
          coupler.name, state.t, h, counted - near);
    }
    near = counted;
  }
  return std::nullopt;
}

// Whether laws along the joint give another wrench there than at the angle
// nearest to that at the step's begin.
bool TurnCounter::depends_on_turns(const Angle& angle, double near,
                                   const SystemTerms& terms,
                                   const SystemState& state) const {
  constexpr double kRoundoff = 1e-9;
  if (angle.is_in_transmission) return true;
  const Coupler& coupler = model_.couplers[index(angle.coupler)];
  const joints::RelativeMotion& motion =
      terms.couplers[index(angle.coupler)].motion;
  joints::CouplerMemory memory = state.memory[index(angle.coupler)];
  const EvaluationTime now = now_of(state);
  const Vector6 taken =
      joints::evaluate(coupler.law, motion, memory, now).wrench;
  memory.near[angle.coordinate] = near;
  const Vector6 right =
      joints::evaluate(coupler.law, motion, memory, now).wrench;
  return (right - taken).norm() > kRoundoff * (right.norm() + taken.norm());
}

}  // namespace limber::dynamics
