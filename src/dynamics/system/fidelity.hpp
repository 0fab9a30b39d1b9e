// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace limber::dynamics {

/// Level of detail of a body's physics (docs/theory/equations.md).
enum class Fidelity { rigid, uncoupled, one_way, coupled, full };

/// "rigid", "uncoupled", "one-way", "coupled",
/// "full".
[[nodiscard]] std::string_view to_string(Fidelity fidelity);
[[nodiscard]] const std::vector<std::string>& fidelity_names();
/// @throws InputError naming the nearest level.
[[nodiscard]] Fidelity parse_fidelity(std::string_view name);

}  // namespace limber::dynamics
