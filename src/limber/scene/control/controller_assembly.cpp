// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/control/controller_assembly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "limber/common/errors.hpp"
#include "limber/scene/control/measured_probe.hpp"
#include "limber/scene/text/error_context.hpp"

namespace limber::scene {
namespace {

dynamics::Measurement measure(const std::vector<Probe>& probes,
                              const std::string& column) {
  const std::string name = column.substr(0, column.rfind('.'));
  const auto probe =
      std::find_if(probes.begin(), probes.end(),
                   [&](const Probe& one) { return one.name == name; });
  LIMBER_EXPECT(probe != probes.end());  // check_scenario has found it
  return measure_probe(*probe, column);
}

}  // namespace

void add_inputs(const Scenario& scenario, dynamics::SystemBuilder& builder) {
  for (const ControllerSpec& spec : scenario.controllers) {
    builder.add_input(spec.name, spec.pid.initial, spec.hold);
  }
}

int find_controller(const Scenario& scenario, const std::string& name) {
  const auto found =
      std::find_if(scenario.controllers.begin(), scenario.controllers.end(),
                   [&](const ControllerSpec& one) { return one.name == name; });
  LIMBER_EXPECT(found != scenario.controllers.end());
  return static_cast<int>(found - scenario.controllers.begin());
}

std::vector<dynamics::ControllerModel> make_controllers(
    const Scenario& scenario, const std::vector<Probe>& probes) {
  std::vector<dynamics::ControllerModel> controllers;
  for (const ControllerSpec& spec : scenario.controllers) {
    with_context("controller '" + spec.name + "'", [&] {
      const auto law =
          std::make_shared<const dynamics::PidController>(spec.pid);
      dynamics::ControllerModel controller{
          .name = spec.name,
          .period = spec.pid.period,
          .offset = spec.offset,
          .writes = {static_cast<int>(controllers.size())},
          .measures = {measure(probes, spec.measures)},
          .memory = law->make_memory(),
          .law = law};
      if (spec.pid.has_rate) {
        controller.measures.push_back(measure(probes, spec.rate));
      }
      controllers.push_back(std::move(controller));
    });
  }
  return controllers;
}

}  // namespace limber::scene
