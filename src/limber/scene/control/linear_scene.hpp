// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/dynamics/analysis/linear_system.hpp"
#include "limber/scene/probes/probe.hpp"
#include "limber/scene/scenario/scenario.hpp"

namespace limber::scene {

/// Selects inputs and outputs of a linear model by name, an output also by the
/// name of its probe; empty: all.
struct LinearSelection {
  std::vector<std::string> inputs = {};
  std::vector<std::string> outputs = {};
};

/// A scene linearised about a state: inputs as in find_linear_inputs, drives by
/// their names in the scenario; outputs the columns of its probes.
struct LinearScene {
  dynamics::LinearSystem system;
  dynamics::LinearModel model;
  std::vector<std::string> open_loops;  ///< controllers that are not in it
  /// Effects that the model lacks, or has only near the reference.
  std::vector<std::string> warnings;
};

/// @param probes of the scenario, with their starts
/// @throws InputError for a body at level `full`, an unknown input or output,
/// with the nearest name, and a named output without derivative.
[[nodiscard]] LinearScene linearise(const Scenario& scenario,
                                    const dynamics::SystemModel& model,
                                    const dynamics::SystemState& state,
                                    const std::vector<Probe>& probes,
                                    const LinearSelection& selection = {});

}  // namespace limber::scene
