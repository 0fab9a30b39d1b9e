// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>

namespace limber::scene {

/// Parts that a dotted key of a scenario may have. Each part is a table inside
/// a table, and toml++, which limits brackets but not dots, calls itself for
/// each when it lets go of them: it would run out of stack.
inline constexpr int kMostKeyParts = 20;

/// Line of the first key with more parts, before anything parses the text.
[[nodiscard]] std::optional<int> find_overlong_key(std::string_view toml);

}  // namespace limber::scene
