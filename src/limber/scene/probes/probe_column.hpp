// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limber::scene {

/// One scalar of a probe: "tip.ux", "m".
struct ProbeColumnName {
  std::string name;
  std::string unit;
};

}  // namespace limber::scene
