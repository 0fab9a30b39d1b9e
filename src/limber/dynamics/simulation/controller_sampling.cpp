// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/controller_sampling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <string>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/dynamics/control/external_law.hpp"
#include "limber/dynamics/equations/coupler_motion.hpp"
#include "limber/dynamics/simulation/breakpoints.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"
#include "limber/dynamics/terms/mean_frame.hpp"

namespace limber::dynamics {
namespace {

[[noreturn]] void fail(const ControllerModel& controller, double t,
                       const std::string& what) {
  throw NumericalError(fmt::format("controller '{}' at t = {:.9g} s: {}",
                                   controller.name, t, what));
}

// Runs foreign code. Its exceptions end the run as errors, except Interrupted.
template <typename Work>
void call(const ControllerModel& controller, double t, const std::string& what,
          const Work& work) {
  try {
    work();
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& error) {
    fail(controller, t, what + error.what());
  } catch (...) {
    fail(controller, t, what + "an exception without a message");
  }
}

}  // namespace

ControllerSampling::ControllerSampling(const SystemModel& model, double start)
    : model_(model), start_(start), flows_(make_flows(model)) {
  if (!model.controllers.empty()) find_links();
}

void ControllerSampling::find_links() {
  for (std::size_t c = 0; c < model_.couplers.size(); ++c) {
    if (!joints::find_inputs(model_.couplers[c].law).empty()) {
      links_.push_back(c);
    }
  }
  for (std::size_t i = 0; i < model_.transmissions.size(); ++i) {
    const auto& laws = model_.transmissions[i].laws;
    if (std::any_of(laws.begin(), laws.end(), [](const auto& law) {
          return !joints::find_inputs(law).empty();
        })) {
      links_.push_back(model_.couplers.size() + i);
    }
  }
}

void ControllerSampling::skip_until(SystemState& state) const {
  const double same = find_same_time(state.t, start_);
  for (std::size_t i = 0; i < model_.controllers.size(); ++i) {
    long& next = state.controllers[i].next;
    next = std::max(next, model_.controllers[i].find_first(state.t, same));
  }
}

double ControllerSampling::calc_energy(Link link,
                                       const SystemState& state) const {
  if (link < model_.couplers.size()) {
    return evaluate_coupler(model_, state, static_cast<CouplerIndex>(link))
        .response.energy;
  }
  link -= model_.couplers.size();
  return evaluate_transmission(model_, state,
                               static_cast<TransmissionIndex>(link))
      .response.energy;
}

void ControllerSampling::write(const ControllerModel& controller,
                               SystemState& state) const {
  for (std::size_t i = 0; i < controller.writes.size(); ++i) {
    const int input = controller.writes[i];
    InputState& line = state.inputs[index(input)];
    const EvaluationTime now{state.t, Side::left, state.inputs};
    const InputValue before = find_input(now, input);
    const double to = written_[i];
    const bool is_held = model_.inputs[index(input)].hold == InputHold::held;
    line = {state.t, is_held ? to : before.value,
            is_held ? 0.0 : (to - before.value) / controller.period,
            before.value, before.rate};
  }
}

void ControllerSampling::sample(std::size_t i, const SystemState& seen,
                                SystemState& state) {
  const ControllerModel& controller = model_.controllers[i];
  ControllerState& own = state.controllers[i];
  measured_.assign(controller.measures.size(), 0.0);
  for (std::size_t m = 0; m < measured_.size(); ++m) {
    const Measurement& measurement = controller.measures[m];
    call(controller, state.t, fmt::format("measuring '{}': ", measurement.name),
         [&] { measured_[m] = measurement.measure(model_, seen); });
    if (std::isfinite(measured_[m])) continue;
    fail(controller, state.t,
         fmt::format("'{}', which it measures, is {}; expected a finite number",
                     measurement.name, measured_[m]));
  }
  written_.assign(controller.writes.size(),
                  std::numeric_limits<double>::quiet_NaN());
  call(controller, state.t, "", [&] {
    controller.law->sample({state.t, own.next, model_, seen, measured_},
                           own.memory, written_);
  });
  for (std::size_t w = 0; w < written_.size(); ++w) {
    if (std::isfinite(written_[w])) continue;
    fail(controller, state.t,
         fmt::format("input '{}' is {} after sample {}; expected a finite "
                     "number (NaN also if it is not written)",
                     model_.inputs[index(controller.writes[w])].name,
                     written_[w], own.next));
  }
  for (std::size_t m = 0; m < own.memory.size(); ++m) {
    if (std::isfinite(own.memory[m])) continue;
    fail(controller, state.t,
         fmt::format("number {} of its memory is {} after sample {}; expected "
                     "a finite number",
                     m + 1, own.memory[m], own.next));
  }
  ++own.next;
  write(controller, state);
}

bool ControllerSampling::repeat_external(SystemState& state) const {
  const double same = find_same_time(state.t, start_);
  bool is_any = false;
  for (std::size_t i = 0; i < model_.controllers.size(); ++i) {
    const ControllerModel& controller = model_.controllers[i];
    long& next = state.controllers[i].next;
    if (next == 0 || !is_external(controller)) continue;
    if (controller.find_time(next - 1) < state.t - same) continue;
    --next;
    is_any = true;
  }
  return is_any;
}

bool ControllerSampling::take(SystemState& state) {
  flows_.clear();
  due_.clear();
  const double same = find_same_time(state.t, start_);
  for (std::size_t i = 0; i < model_.controllers.size(); ++i) {
    const double next =
        model_.controllers[i].find_time(state.controllers[i].next);
    if (next <= state.t + same) due_.push_back(i);
  }
  if (due_.empty()) return false;
  seen_ = state;
  if (model_.nodal_count > 0) update_mean_frames(model_, seen_);
  SystemState after = state;
  for (const std::size_t i : due_) sample(i, seen_, after);
  bool has_jump = false;
  for (std::size_t i = 0; i < state.inputs.size(); ++i) {
    const InputState& line = after.inputs[i];
    has_jump |= line.since == state.t && (line.value != line.value_before ||
                                          line.rate != line.rate_before);
  }
  if (has_jump) {
    const Eigen::Index first = EnergyRows(model_).couplers;
    for (const Link link : links_) {
      flows_.supplied[first + static_cast<Eigen::Index>(link)] +=
          calc_energy(link, after) - calc_energy(link, state);
    }
  }
  state = after;
  return has_jump;
}

}  // namespace limber::dynamics
