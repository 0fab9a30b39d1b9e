// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/scene/probes/coupler_traits.hpp"
#include "limber/scene/probes/probe_column.hpp"
#include "limber/scene/scenario/scenario.hpp"

namespace limber::scene {

/// A probe of a coupler or a transmission.
///
/// Equation   on side M its law's wrench (f, t) at Mo; on side F, at Fo,
///            (-f, -t - p_FM x f). Coordinates as in its law; for a spring or a
///            tendon the length, with the tension as effort.
struct CouplerProbe {
  CouplerProbeSpec spec;
  dynamics::CouplerIndex coupler;            ///< or
  dynamics::TransmissionIndex transmission;  ///< the other is -1
  /// Its coordinates, in order.
  std::vector<joints::AxisCoordinate::Kind> coordinates;
};

/// @param known all of them; of equal names the first one applies
/// @returns the index of the coupler that `spec` names
/// @throws InputError for an unknown name, with the nearest, or a quantity that
/// the coupler does not have.
std::size_t check_coupler_probe(const CouplerProbeSpec& spec,
                                const std::vector<CouplerTraits>& known);

/// @throws InputError like check_coupler_probe.
[[nodiscard]] CouplerProbe make_coupler_probe(
    const CouplerProbeSpec& spec, const dynamics::SystemModel& model);

/// Name and unit of each column: "NAME.q" [rad], "NAME.fx" [N], ...
[[nodiscard]] std::vector<ProbeColumnName> column_names(
    const CouplerProbe& probe, const std::string& name);

/// Appends the value of each column in `state`, in the units of column_names().
/// @throws NumericalError if a coordinate is undefined.
void append_values(const CouplerProbe& probe,
                   const dynamics::SystemModel& model,
                   const dynamics::SystemState& state,
                   std::vector<double>& values);

}  // namespace limber::scene
