// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>

namespace limber::scene {

/// Largest number of parts of a dotted key in a scenario. Each part is a nested
/// table, and toml++, which limits brackets but not dots, destroys them
/// recursively: it could overflow the stack.
inline constexpr int kMostKeyParts = 20;

/// Line of the first key with more parts, before anything parses the text.
[[nodiscard]] std::optional<int> find_overlong_key(std::string_view toml);

}  // namespace limber::scene
