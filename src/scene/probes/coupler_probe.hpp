// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "dynamics/system_model.hpp"
#include "dynamics/system_state.hpp"
#include "scene/coupler_traits.hpp"
#include "scene/probe_column.hpp"
#include "scene/scenario.hpp"

namespace limber::scene {

/// A coupler or a transmission that is followed in time.
///
/// Equation   on side M its law's wrench (f, t) at Mo; on side F, at Fo,
///            (-f, -t - p_FM x f). Coordinates as its law counts them; of a
///            spring or a tendon the length, and the effort is the tension.
struct CouplerProbe {
  CouplerProbeSpec spec;
  bool is_transmission = false;
  int index = 0;  ///< of SystemModel::couplers or transmissions
  /// What it can move along, in order.
  std::vector<joints::AxisCoordinate::Kind> coordinates;
};

/// @param known all of them; names may be shared, the first one counts
/// @returns the index of the one that `spec` names
/// @throws InputError for a name that is not there, with the nearest, or a
/// quantity that the coupler does not have.
std::size_t check_coupler_probe(const CouplerProbeSpec& spec,
                                const std::vector<CouplerTraits>& known);

/// @throws InputError like check_coupler_probe.
[[nodiscard]] CouplerProbe make_coupler_probe(
    const CouplerProbeSpec& spec, const dynamics::SystemModel& model);

/// Name and unit of each column: "NAME.q" [rad], "NAME.fx" [N], ...
[[nodiscard]] std::vector<ProbeColumnName> column_names(
    const CouplerProbe& probe, const std::string& name);

/// Appends the value of each column in `state`.
/// @throws NumericalError where a coordinate has no meaning.
void append_values(const CouplerProbe& probe,
                   const dynamics::SystemModel& model,
                   const dynamics::SystemState& state,
                   std::vector<double>& values);

}  // namespace limber::scene
