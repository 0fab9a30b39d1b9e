// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "limber/dynamics/system/system_state.hpp"
#include "limber/dynamics/terms/system_terms.hpp"

namespace limber::dynamics {

/// A drive of a joint or a transmission.
struct PlacedDrive {
  bool is_transmission = false;
  std::size_t index = 0;       ///< of the coupler or the transmission
  std::size_t coordinate = 0;  ///< of a joint
  const joints::ScalarLaw* law = nullptr;
  bool pulls_only = false;  ///< a tendon
};

/// All of a model, which they refer to.
[[nodiscard]] std::vector<PlacedDrive> find_drives(const SystemModel& model);

/// Those with a largest effort.
[[nodiscard]] std::vector<PlacedDrive> find_limited_drives(
    const SystemModel& model);

/// Name of its coupler or transmission.
[[nodiscard]] const std::string& name_of(const PlacedDrive& drive,
                                         const SystemModel& model);

/// Motion of its coordinate.
[[nodiscard]] joints::ScalarMotion find_motion(const SystemModel& model,
                                               const SystemState& state,
                                               const PlacedDrive& drive);
/// The same by `terms` at `state`.
[[nodiscard]] joints::ScalarMotion find_motion(const SystemModel& model,
                                               const SystemState& state,
                                               const SystemTerms& terms,
                                               const PlacedDrive& drive);

}  // namespace limber::dynamics
