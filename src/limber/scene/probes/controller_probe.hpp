// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/scene/probes/probe_column.hpp"

namespace limber::scene {

/// A probe of the input that a controller writes.
struct ControllerProbe {
  int input = 0;  ///< index in the system
};

/// "NAME.u", in the unit of the loads or drives that follow it.
[[nodiscard]] std::vector<ProbeColumnName> column_names(
    const ControllerProbe& probe, const std::string& name);

/// Appends its value; at a sample the value just written.
void append_values(const ControllerProbe& probe,
                   const dynamics::SystemModel& model,
                   const dynamics::SystemState& state,
                   std::vector<double>& values);

}  // namespace limber::scene
