// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/scene/robot/robot.hpp"

namespace limber::scene {

/// Quantities available for probes of a coupler.
struct CouplerTraits {
  std::string name;
  bool has_frames = true;  ///< connects two frames; a tendon or gear does not
  int coordinates = 0;     ///< count; a spring has one, its length
  std::string why_none;    ///< why there is no such coupler, if so
};

/// All couplers in a robot's file, before they are built.
[[nodiscard]] std::vector<CouplerTraits> find_coupler_traits(
    const Robot& robot);

}  // namespace limber::scene
