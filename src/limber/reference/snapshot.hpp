// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/dynamics/system/system_state.hpp"

namespace limber::reference {

/// The observed frames at one time.
struct Snapshot {
  double time = 0.0;                        ///< [s]
  std::vector<dynamics::BodyState> frames;  ///< one a observed frame
  double kinetic = 0.0;                     ///< [J]
  double coupler = 0.0;                     ///< in bushings and springs [J]
};

}  // namespace limber::reference
