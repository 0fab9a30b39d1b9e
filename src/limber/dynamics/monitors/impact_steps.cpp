// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/impact_steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace limber::dynamics {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();
// Of a part to the next: generalized-alpha carries a part of the last
// acceleration on, which must not grow with the steps [-].
constexpr double kPartGrowth = 1.25;
constexpr double kMargin = 1.1;  // of a step's length without a repeat [-]
// Least and largest reduction of a step that is repeated [-].
constexpr double kLeastCut = 0.5;
constexpr double kMostCut = 0.1;
// Of a part in which an impact begins, other than at its end: the load there is
// many times that at the middle [-].
constexpr double kOnset = 0.02;
constexpr double kSlow = 0.05;  // of the elastic speed, at rest [-]
constexpr double kTurn = 0.5;   // phase that a touch may take to turn [rad]
constexpr double kLeastSpeed = 1e-9;  // of an impact [m/s]

}  // namespace

ImpactSteps::ImpactSteps(const SystemModel& model, double steps, int most_parts)
    : model_(model),
      steps_(steps),
      most_parts_(most_parts),
      approach_(make_state(model)),
      longest_(kUnlimited) {}

// Of bounces that end within two steps [m/s].
double ImpactSteps::find_slow() const {
  return std::max(step_ * model_.gravity_W.norm(), kLeastSpeed);
}

double ImpactSteps::limit(double h, const ContactStartObserver& touches) {
  if (parts_ == 0) step_ = h;
  const double first = touches.find_first_step(steps_, find_slow());
  is_struck_ = first < kUnlimited || frequency_ > 0.0;
  longest_ = std::min(longest_, first);
  if (!(longest_ < h)) {
    parts_ = 0;
    return h;
  }
  if (++parts_ > most_parts_) {
    has_excess_ = true;
    is_struck_ = false;
    return h;
  }
  return h < 2.0 * longest_ ? 0.5 * h : longest_;  // no short rest
}

bool ImpactSteps::is_fast(double speed, double elastic_speed) const {
  return speed > kSlow * elastic_speed &&
         std::hypot(speed, elastic_speed) > find_slow();
}

// Whether a struck pair is at its largest depth, where it hardly moves.
bool ImpactSteps::turns_back(const joints::TouchReading& now, double h) const {
  return is_struck_ && now.elastic_speed > find_slow() &&
         now.frequency * (quiet_ + h) < kTurn;
}

// Normal speed on the touch at `after` with the velocities at `before`: a step
// that does not resolve an impact may end it.
double ImpactSteps::find_approach(std::size_t touch, const SystemState& before,
                                  const SystemState& after,
                                  ContactStartObserver& touches) {
  approach_ = after;
  approach_.etadot = before.etadot;
  approach_.udot_H = before.udot_H;
  for (std::size_t b = 0; b < approach_.bodies.size(); ++b) {
    const BodyState& from = before.bodies[b];
    BodyState& body = approach_.bodies[b];
    body.v_WB_W = from.v_WB_W;
    body.w_WB_B = body.quat_WB.conjugate() * (from.quat_WB * from.w_WB_B);
  }
  return touches.read(touch, approach_).normal_speed;
}

std::optional<double> ImpactSteps::find_shorter(const SystemState& before,
                                                const SystemState& after,
                                                double h,
                                                ContactStartObserver& touches) {
  frequency_ = rest_frequency_ = 0.0;
  is_quiet_ = true;
  if (parts_ > most_parts_) return std::nullopt;
  for (std::size_t i = 0; i < touches.count(); ++i) {
    if (!touches.is_touching(i)) continue;
    const joints::TouchReading now = touches.read(i, after);
    if (!(now.frequency > frequency_)) continue;
    const double elastic = now.elastic_speed;
    const bool moves =
        is_fast(now.normal_speed, elastic) ||
        is_fast(touches.read(i, before).normal_speed, elastic) ||
        is_fast(find_approach(i, before, after, touches), elastic);
    if (!moves && !turns_back(now, h)) {
      rest_frequency_ = std::max(rest_frequency_, now.frequency);
      continue;
    }
    is_quiet_ = is_quiet_ && !moves;
    frequency_ = now.frequency;
    fastest_ = touches.pair_of(i);
  }
  const double angle = frequency_ * h;
  const double most = (is_struck_ ? 1.0 : kOnset) * std::numbers::pi / steps_;
  if (!(angle > kMargin * most)) return std::nullopt;
  if (++parts_ > most_parts_) {
    has_excess_ = true;
    return std::nullopt;
  }
  longest_ = h * std::clamp(most / angle, kMostCut, kLeastCut);
  return longest_;
}

bool ImpactSteps::take_onset() {
  if (is_struck_ || !(frequency_ > 0.0)) return false;
  is_struck_ = true;
  return true;
}

bool ImpactSteps::rests_stiffly(double h) const {
  return rest_frequency_ * h > std::numbers::pi / steps_;
}

void ImpactSteps::accept(double h) {
  const double most =
      frequency_ > 0.0 ? std::numbers::pi / (steps_ * frequency_) : kUnlimited;
  quiet_ = is_quiet_ ? quiet_ + h : 0.0;
  longest_ = std::min(kPartGrowth * std::max(h, longest_), most);
}

std::optional<std::size_t> ImpactSteps::take_excess() {
  if (!has_excess_ || was_reported_) return std::nullopt;
  was_reported_ = true;
  return fastest_;
}

void ImpactSteps::exchange_memory(Archive& archive) {
  archive(longest_, step_, parts_, is_struck_, quiet_, frequency_, fastest_,
          rest_frequency_, has_excess_, was_reported_);
}

}  // namespace limber::dynamics
