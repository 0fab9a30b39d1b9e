// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/control/saturation_observer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "limber/common/index.hpp"
#include "limber/dynamics/control/pid_controller.hpp"

namespace limber::dynamics {
namespace {

constexpr long kSamples = 20;
constexpr long kChanges = 8;
constexpr double kSlowest = 10.0;  // samples between changes / those of the lag
constexpr double kPerCycle = 20.0;  // samples of the suggested period
constexpr double kGrowth = 10.0;
constexpr double kVisible = 0.01;     // of the range
constexpr double kFewestSteps = 8.0;  // in a period
constexpr double kSteps = 10.0;       // in a period, suggested
constexpr double kAtLimit = 1e-9;     // of the range

bool follows(const std::vector<int>& inputs, int input) {
  return std::find(inputs.begin(), inputs.end(), input) != inputs.end();
}

}  // namespace

std::string name_followers(const SystemModel& model, int input) {
  std::vector<std::string> names;
  for (const Coupler& coupler : model.couplers) {
    if (follows(joints::find_inputs(coupler.law), input)) {
      names.push_back(fmt::format("joint '{}'", coupler.name));
    }
  }
  for (const Transmission& line : model.transmissions) {
    if (std::any_of(line.laws.begin(), line.laws.end(), [&](const auto& law) {
          return follows(joints::find_inputs(law), input);
        })) {
      names.push_back(fmt::format("tendon '{}'", line.name));
    }
  }
  for (const Load& load : model.loads) {
    const auto* of = std::get_if<InputFunction>(&load.function);
    if (of != nullptr && of->input == input) {
      names.push_back(fmt::format("load '{}'", load.name));
    }
  }
  for (const ControllerModel& controller : model.controllers) {
    const auto* pid = dynamic_cast<const PidController*>(controller.law.get());
    if (pid != nullptr &&
        follows(joints::find_inputs(pid->parameters().reference), input)) {
      names.push_back(fmt::format("controller '{}'", controller.name));
    }
  }
  if (names.empty()) return "no follower";
  return fmt::format("{}", fmt::join(names, ", "));
}

SaturationObserver::SaturationObserver(const SystemModel& model)
    : model_(model) {
  for (std::size_t i = 0; i < model.controllers.size(); ++i) {
    const auto* pid =
        dynamic_cast<const PidController*>(model.controllers[i].law.get());
    if (pid == nullptr) continue;
    const PidParameters& p = pid->parameters();
    if (!std::isfinite(p.upper - p.lower)) continue;
    const double lag =
        1.0 + static_cast<double>(p.delay) + p.filter_time / p.period;
    outputs_.push_back({.controller = i,
                        .lower = p.lower,
                        .upper = p.upper,
                        .longest = std::lround(kSlowest * lag)});
  }
}

void SaturationObserver::count_sample(double value, Output& output) {
  const double near = kAtLimit * (output.upper - output.lower);
  const int side = value <= output.lower + near   ? -1
                   : value >= output.upper - near ? 1
                                                  : 0;
  if (output.seen - output.changed > output.longest) {
    output.count = output.changes = 0;
  }
  if (side == 0) return;
  if (side == -output.side) {
    if (output.changes == 0) output.first = output.seen;
    output.changed = output.seen;
    ++output.changes;
  }
  output.side = side;
  if (output.changes > 0) ++output.count;
}

void SaturationObserver::count_jump(double value, Output& output) {
  const double jump = value - output.value;
  const bool continues =
      jump * output.jump < 0.0 && std::abs(jump) >= std::abs(output.jump);
  output.jumps = continues ? output.jumps + 1 : 0;
  if (!continues) output.first_jump = jump;
  output.jump = jump;
  output.value = value;
}

std::string SaturationObserver::find_oscillation(const Output& output,
                                                 double step) const {
  const double period = model_.controllers[output.controller].period;
  const double range = output.upper - output.lower;
  double frequency = 0.5 / period;
  std::string what;
  if (output.count >= kSamples && output.changes >= kChanges) {
    const double duration =
        static_cast<double>(output.seen - output.first) * period;
    frequency = 0.5 * static_cast<double>(output.changes - 1) / duration;
    what = fmt::format(
        "its output alternates between its limits, {:g} and {:g}, at about "
        "{:.3g} Hz, with {} changes in {:.3g} s",
        output.lower, output.upper, frequency, output.changes, duration);
  } else if (output.jumps >= kSamples &&
             std::abs(output.jump) >=
                 std::max(kGrowth * std::abs(output.first_jump),
                          kVisible * range)) {
    what = fmt::format(
        "its output alternates from sample to sample, at {:.3g} Hz, and grows, "
        "in {} samples from {:.2g} to {:.2g} between two",
        frequency, output.jumps, std::abs(output.first_jump),
        std::abs(output.jump));
  } else {
    return "";
  }
  const std::string steps =
      step * kFewestSteps > period
          ? fmt::format("steps of {:.2g} s, ", period / kSteps)
          : "";
  return fmt::format(
      "{}, as in an unstable sampled loop; try {}a period of {:.2g} s or "
      "smaller gains",
      what, steps, std::min(0.5 * period, 1.0 / (kPerCycle * frequency)));
}

void SaturationObserver::include(const SystemState& state, double step,
                                 std::vector<std::string>& warnings) {
  for (Output& output : outputs_) {
    const long next = state.controllers[output.controller].next;
    if (output.was_reported || next == output.seen) continue;
    output.seen = next;
    const ControllerModel& controller = model_.controllers[output.controller];
    const InputState& line = state.inputs[index(controller.writes.front())];
    const double value = line.value + line.rate * controller.period;
    count_sample(value, output);
    count_jump(value, output);
    const std::string found = find_oscillation(output, step);
    if (found.empty()) continue;
    output.was_reported = true;
    warnings.push_back(fmt::format(
        "controller '{}' ({}, period {:.4g} s) at t = {:.9g} s: {}",
        controller.name, name_followers(model_, controller.writes.front()),
        controller.period, state.t, found));
  }
}

void SaturationObserver::exchange_memory(Archive& archive) {
  for (Output& output : outputs_) {
    archive(output.seen, output.side, output.changed, output.first,
            output.count, output.changes, output.value, output.jump,
            output.first_jump, output.jumps, output.was_reported);
  }
}

}  // namespace limber::dynamics
