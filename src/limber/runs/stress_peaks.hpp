// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "limber/common/types.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/results/history.hpp"
#include "limber/scene/build/build_system.hpp"

namespace limber::runs {

/// Largest von Mises stress on a link's surface, over all steps of a run.
struct StressPeak {
  std::string link;
  double von_mises = 0.0;         ///< [Pa]
  double time = 0.0;              ///< [s]
  std::size_t node = 0;           ///< Gmsh node tag
  std::string layer;              ///< of a shell or beam (name_section_place)
  Vector3 p_L = Vector3::Zero();  ///< the node, undeformed, link frame [m]
  /// Error of the averaging over elements in the energy norm, at the output
  /// nearest to the peak (flexbody::find_averaging_error); none at level full
  /// and of beams and shells [-].
  std::optional<double> averaging_error;
  /// At that node and time, von Mises stress of the static-deformation modes
  /// over that of all modes, which eigenmodes alone would lack; none if the
  /// kinds of modes are unknown [-].
  std::optional<double> correction_fraction;
};

/// One for each link whose stress [output] requests and that was deformed.
[[nodiscard]] std::vector<StressPeak> find_stress_peaks(
    const scene::BuiltScene& built, const results::History& history,
    const dynamics::RunRecord& record);

/// The record of a single state, such as an equilibrium: its values are peaks.
[[nodiscard]] dynamics::RunRecord record_state(
    const scene::BuiltScene& built, const dynamics::SystemState& state);

/// A node, and where in the section of a shell or beam there.
struct PeakNode {
  std::size_t tag = 0;
  std::string layer;  ///< of solids empty
};

/// Where a column of a stress probe had its peak, one entry a column; nothing
/// for other probes and for stress at a single point.
[[nodiscard]] std::vector<std::optional<PeakNode>> find_peak_nodes(
    const scene::BuiltScene& built, const dynamics::RunRecord& record);

}  // namespace limber::runs
