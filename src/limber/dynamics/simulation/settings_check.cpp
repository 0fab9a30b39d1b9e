// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/settings_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <string>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/dynamics/bodies/body.hpp"
#include "limber/dynamics/monitors/rounding_limit.hpp"
#include "limber/dynamics/simulation/breakpoints.hpp"

namespace limber::dynamics {
namespace {

// Shortest step, relative to the time at the start [-]. Relative to the
// duration, the number of steps limits it.
constexpr double kShortest = 1e-11;

void check_controllers(const SystemModel& model, const SystemState& state) {
  LIMBER_EXPECT(state.inputs.size() == model.inputs.size());
  LIMBER_EXPECT(state.controllers.size() == model.controllers.size());
  const double same = find_same_time(state.t, state.t);
  for (std::size_t i = 0; i < model.controllers.size(); ++i) {
    const ControllerModel& controller = model.controllers[i];
    const ControllerState& own = state.controllers[i];
    LIMBER_EXPECT(own.memory.size() == controller.memory.size());
    LIMBER_EXPECT(own.next >= 0);
    if (own.next > 0 && controller.find_time(own.next - 1) > state.t + same) {
      throw InputError(fmt::format(
          "controller '{}': its last sample was taken at {:g} s, after the "
          "start at {:g} s; begin with a state in which it is new",
          controller.name, controller.find_time(own.next - 1), state.t));
    }
  }
}

// @param what name of the step: begins the message
void check_step(const std::string& what, double step, double start) {
  if (!(step > 0.0) || !std::isfinite(step)) {
    throw InputError(fmt::format("{} is {:g} s; expected > 0", what, step));
  }
  const double shortest = kShortest * std::abs(start);
  if (step >= shortest) return;
  throw InputError(fmt::format(
      "{} is {:g} s, which double precision does not resolve at the start, "
      "{:g} s; expected at least {:.2g} s, or a start nearer to zero",
      what, step, start, shortest));
}

// "a, b or c": the integrators that have a property.
std::string name_those(bool IntegratorTraits::*property) {
  std::vector<std::string> names;
  for (const std::string& name : integrator_names()) {
    if (traits_of(parse_integrator(name)).*property) names.push_back(name);
  }
  const std::string last = names.back();
  names.pop_back();
  return names.empty() ? last
                       : fmt::format("{} or {}", fmt::join(names, ", "), last);
}

}  // namespace

const ControllerModel* find_hidden_memory(const SystemModel& model) {
  for (const ControllerModel& controller : model.controllers) {
    if (controller.law->has_hidden_memory()) return &controller;
  }
  return nullptr;
}

void refuse_hidden_memory(const SystemModel& model, const std::string& why) {
  const ControllerModel* controller = find_hidden_memory(model);
  if (controller == nullptr) return;
  throw InputError(
      fmt::format("controller '{}' keeps data outside its memory, so that its "
                  "samples cannot be repeated, but {}",
                  controller->name, why));
}

void check_settings(const SystemModel& model, const SystemState& state,
                    const SimulationSettings& settings) {
  LIMBER_EXPECT(state.bodies.size() == model.bodies.size());
  LIMBER_EXPECT(state.eta.size() == model.modal_count);
  LIMBER_EXPECT(state.etadot.size() == model.modal_count);
  LIMBER_EXPECT(state.maxwell.size() == model.maxwell_count);
  LIMBER_EXPECT(state.u_H.size() == model.nodal_count);
  LIMBER_EXPECT(state.udot_H.size() == model.nodal_count);
  LIMBER_EXPECT(state.memory.size() ==
                model.couplers.size() + model.transmissions.size());
  check_controllers(model, state);
  check_rounding(model, state);
  LIMBER_EXPECT(state.pair_memory.size() == model.pair_memory_size);
  const auto refuse = [](const std::string& text) { throw InputError(text); };
  if (!(settings.end_time > state.t) || !std::isfinite(settings.end_time)) {
    refuse(fmt::format("duration: the end {:g} s is not after the start {:g} s",
                       settings.end_time, state.t));
  }
  check_step("step", settings.step, state.t);
  for (std::size_t i = 0; i < settings.step_changes.size(); ++i) {
    const StepChange& change = settings.step_changes[i];
    check_step(fmt::format("step from {:g} s on", change.from), change.step,
               state.t);
    if (i > 0 && !(change.from > settings.step_changes[i - 1].from)) {
      refuse(
          fmt::format("steps change at {:g} s after {:g} s; times must "
                      "increase",
                      change.from, settings.step_changes[i - 1].from));
    }
  }
  if (!(settings.tolerance >= 0.0) || !std::isfinite(settings.tolerance)) {
    refuse(fmt::format("tolerance is {:g} m; expected >= 0, 0 for fixed steps",
                       settings.tolerance));
  }
  const IntegratorTraits& traits = traits_of(settings.integrator);
  if (settings.tolerance > 0.0 && !traits.is_adaptive) {
    refuse(fmt::format(
        "only {} takes steps to a tolerance; give a step instead, or no "
        "integrator",
        name_those(&IntegratorTraits::is_adaptive)));
  }
  if (settings.most_steps < 1) {
    refuse(fmt::format("most_steps is {}; expected >= 1", settings.most_steps));
  }
  if (!(settings.rho_inf >= 0.0) || !(settings.rho_inf <= 1.0)) {
    refuse(fmt::format("rho_inf is {:g}; expected 0 to 1", settings.rho_inf));
  }
  if (!(settings.impact_steps >= 1.0)) refuse("impact_steps must be >= 1");
  if (!(settings.newton_tolerance >= 0.0) || settings.newton_iterations < 1) {
    refuse("newton_tolerance must be >= 0, newton_iterations > 0");
  }
  for (const Coupler& coupler : model.couplers) {
    if (traits.takes_ideal_joints || !joints::is_ideal(coupler.law)) continue;
    refuse(
        fmt::format("joint '{}' is ideal, which {} does not integrate; use {}",
                    coupler.name, traits.name,
                    name_those(&IntegratorTraits::takes_ideal_joints)));
  }
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (traits.takes_nodes || has_dense_block(model, b)) continue;
    refuse(fmt::format(
        "body '{}' is at level {}, which {} does not integrate; use {}",
        model.bodies[b].name, to_string(model.bodies[b].fidelity), traits.name,
        name_those(&IntegratorTraits::takes_nodes)));
  }
}

}  // namespace limber::dynamics
