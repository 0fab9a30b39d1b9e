// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "scene/robot.hpp"

namespace limber::scene {

/// What a probe of a coupler can follow.
struct CouplerTraits {
  std::string name;
  bool has_frames = true;  ///< joins two frames; a tendon or gear does not
  int coordinates = 0;     ///< a spring's length is one
  std::string why_none;    ///< why there is no such coupler after all
};

/// All couplers that a robot names, before any of them is made.
[[nodiscard]] std::vector<CouplerTraits> find_coupler_traits(
    const Robot& robot);

}  // namespace limber::scene
