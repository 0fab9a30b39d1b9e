// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/probes/probe.hpp"

#include <fmt/format.h>

#include "limber/common/errors.hpp"
#include "limber/common/overloaded.hpp"

namespace limber::scene {

std::vector<ProbeColumnName> column_names(const Probe& probe) {
  return std::visit(
      [&](const auto& of) { return column_names(of, probe.name); }, probe.of);
}

void set_start(Probe& probe, const dynamics::SystemModel& model,
               const dynamics::SystemState& state) {
  auto* point = std::get_if<PointProbe>(&probe.of);
  if (point != nullptr) set_start(*point, model, state);
}

std::vector<double> evaluate_all(const std::vector<Probe>& probes,
                                 const dynamics::SystemModel& model,
                                 const dynamics::SystemState& state) {
  std::vector<double> values;
  values.reserve(3 * probes.size());
  for (const Probe& probe : probes) {
    try {
      std::visit(Overloaded{[&](const PointProbe& point) {
                              const Vector3 value =
                                  evaluate(point, model, state);
                              values.insert(values.end(), value.data(),
                                            value.data() + 3);
                            },
                            [&](const auto& other) {
                              append_values(other, model, state, values);
                            }},
                 probe.of);
    } catch (const NumericalError& error) {
      throw NumericalError(fmt::format("probe '{}' at t = {:.9g} s: {}",
                                       probe.name, state.t, error.what()));
    }
  }
  return values;
}

}  // namespace limber::scene
