// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "limber/dynamics/system/system_model.hpp"

namespace limber::dynamics {

/// A drive with a largest effort, of a joint or a transmission.
struct LimitedDrive {
  bool is_transmission = false;
  std::size_t index = 0;       ///< of the coupler or the transmission
  std::size_t coordinate = 0;  ///< of a joint
  const joints::ScalarLaw* law = nullptr;
  bool pulls_only = false;  ///< a tendon
};

/// All of a model, which they refer to.
[[nodiscard]] std::vector<LimitedDrive> find_limited_drives(
    const SystemModel& model);

/// Name of its coupler or transmission.
[[nodiscard]] const std::string& name_of(const LimitedDrive& drive,
                                         const SystemModel& model);

}  // namespace limber::dynamics
