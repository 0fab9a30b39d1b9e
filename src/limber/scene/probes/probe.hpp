// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "limber/scene/probes/contact_probe.hpp"
#include "limber/scene/probes/controller_probe.hpp"
#include "limber/scene/probes/coupler_probe.hpp"
#include "limber/scene/probes/point_probe.hpp"
#include "limber/scene/probes/stress_probe.hpp"

namespace limber::scene {

/// A quantity that a run records at every output: one to six columns.
struct Probe {
  std::string name;
  std::variant<PointProbe, CouplerProbe, ContactProbe, ControllerProbe,
               StressProbe>
      of;
};

/// Name and unit of each of a probe's columns: "tip.ux" [m], ...
[[nodiscard]] std::vector<ProbeColumnName> column_names(const Probe& probe);

/// Sets the start, relative to which displacement and rotation are measured.
void set_start(Probe& probe, const dynamics::SystemModel& model,
               const dynamics::SystemState& state);

/// All columns of all probes in `state`, in order.
/// @throws NumericalError naming a probe whose quantity is undefined.
[[nodiscard]] std::vector<double> evaluate_all(
    const std::vector<Probe>& probes, const dynamics::SystemModel& model,
    const dynamics::SystemState& state);

}  // namespace limber::scene
