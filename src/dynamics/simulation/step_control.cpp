// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/step_control.hpp"

#include <algorithm>
#include <cmath>

namespace limber::dynamics {
namespace {

constexpr double kFirstShare = 1e-4;  // first step relative to the span [-]
constexpr double kSafety = 0.8;
constexpr double kWorthGrowing = 1.5;
constexpr double kMostGrowth = 4.0;
constexpr double kMostShrinking = 0.1;
constexpr double kMostTurn = 1.0;  // [rad]

}  // namespace

StepControl::StepControl(const ErrorBudget& budget, double span, double longest,
                         double refinement)
    : budget_(budget),
      longest_(refinement * longest),
      most_turn_(refinement * kMostTurn),
      h_(std::min(longest_, refinement * kFirstShare * span)) {}

double StepControl::propose(const SystemState& state, double left) const {
  double h = std::min(h_, longest_);
  for (const BodyState& body : state.bodies) {
    const double spin = body.w_WB_B.norm();
    if (spin * h > most_turn_) h = most_turn_ / spin;
  }
  // Two equal steps instead of a full one and a short one.
  if (h >= left) return left;
  return 2.0 * h > left ? 0.5 * left : h;
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

}  // namespace limber::dynamics
