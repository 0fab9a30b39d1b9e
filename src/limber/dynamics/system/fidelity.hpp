// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace limber::dynamics {

/// Level of detail of a body's physics (docs/theory/equations.md).
enum class Fidelity {
  rigid,
  uncoupled,
  one_way,
  coupled,
  nonlinear,  ///< coupled, to second order in the modes
  full
};

/// Whether rotation and modes act on each other, and loads and couplers on the
/// deformed body.
[[nodiscard]] constexpr bool is_coupled(Fidelity fidelity) {
  return fidelity == Fidelity::coupled || fidelity == Fidelity::nonlinear;
}

/// "rigid", "uncoupled", "one-way", "coupled", "nonlinear", "full".
[[nodiscard]] std::string_view to_string(Fidelity fidelity);
[[nodiscard]] const std::vector<std::string>& fidelity_names();
/// @throws InputError naming the nearest level.
[[nodiscard]] Fidelity parse_fidelity(std::string_view name);

}  // namespace limber::dynamics
