// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/impact_steps.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace limber::dynamics {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();
// Of a part to the next: generalized-alpha carries a part of the last
// acceleration on, which must not grow with the steps [-].
constexpr double kPartGrowth = 1.25;
constexpr int kMostParts = 1000;  // of a step of the run
constexpr double kMargin = 1.1;   // of a step's length without a repeat [-]
// Least and largest reduction of a step that is repeated [-].
constexpr double kLeastCut = 0.5;
constexpr double kMostCut = 0.1;
constexpr double kSlow = 0.05;        // of the elastic speed, at rest [-]
constexpr double kLeastSpeed = 1e-9;  // of an impact [m/s]

}  // namespace

ImpactSteps::ImpactSteps(const SystemModel& model, double steps)
    : model_(model), steps_(steps), longest_(kUnlimited) {}

// Of bounces that end within two steps [m/s].
double ImpactSteps::find_slow() const {
  return std::max(step_ * model_.gravity_W.norm(), kLeastSpeed);
}

double ImpactSteps::limit(double h, const TouchWatch& touches) {
  if (parts_ == 0) step_ = h;
  longest_ = std::min(longest_, touches.find_first_step(steps_, find_slow()));
  if (!(longest_ < h)) {
    parts_ = 0;
    return h;
  }
  if (++parts_ > kMostParts) {
    has_excess_ = true;
    return h;
  }
  return h < 2.0 * longest_ ? 0.5 * h : longest_;  // no short rest
}

std::optional<double> ImpactSteps::find_shorter(const SystemState& before,
                                                const SystemState& after,
                                                double h, TouchWatch& touches) {
  frequency_ = rest_frequency_ = 0.0;
  if (parts_ > kMostParts) return std::nullopt;
  for (std::size_t i = 0; i < touches.count(); ++i) {
    if (!touches.is_touching(i)) continue;
    const joints::TouchReading now = touches.read(i, after);
    if (!(now.frequency > frequency_)) continue;
    const double slow = std::max(find_slow(), kSlow * now.elastic_speed);
    if (!(now.normal_speed > slow) &&
        !(touches.read(i, before).normal_speed > slow)) {
      rest_frequency_ = std::max(rest_frequency_, now.frequency);
      continue;
    }
    frequency_ = now.frequency;
    fastest_ = touches.pair_of(i);
  }
  const double angle = frequency_ * h;
  const double most = std::numbers::pi / steps_;
  if (!(angle > kMargin * most)) return std::nullopt;
  if (++parts_ > kMostParts) {
    has_excess_ = true;
    return std::nullopt;
  }
  longest_ = h * std::clamp(most / angle, kMostCut, kLeastCut);
  return longest_;
}

bool ImpactSteps::rests_stiffly(double h) const {
  return rest_frequency_ * h > std::numbers::pi / steps_;
}

void ImpactSteps::accept(double h) {
  const double most =
      frequency_ > 0.0 ? std::numbers::pi / (steps_ * frequency_) : kUnlimited;
  longest_ = std::min(kPartGrowth * std::max(h, longest_), most);
}

std::optional<std::size_t> ImpactSteps::take_excess() {
  if (!has_excess_ || was_told_) return std::nullopt;
  was_told_ = true;
  return fastest_;
}

void ImpactSteps::exchange_memory(Archive& archive) {
  archive(longest_, step_, parts_, frequency_, fastest_, rest_frequency_,
          has_excess_, was_told_);
}

}  // namespace limber::dynamics
