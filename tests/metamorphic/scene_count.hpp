// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <string>

namespace limber::metamorphic {

/// Number of random scenes for each relation: LIMBER_SCENES of the environment
/// (scripts/metamorphic), else that of the gate.
inline unsigned count_scenes() {
  const char* text = std::getenv("LIMBER_SCENES");
  return text == nullptr ? 60U : static_cast<unsigned>(std::stoul(text));
}

}  // namespace limber::metamorphic
