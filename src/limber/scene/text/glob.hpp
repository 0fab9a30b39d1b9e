// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace limber::scene {

/// Whether a name contains `*` (any text) or `?` (any one byte).
[[nodiscard]] bool is_pattern(std::string_view name);

/// Whether the whole of `name` matches `pattern`; time is at most the product
/// of their lengths.
[[nodiscard]] bool matches(std::string_view pattern, std::string_view name);

}  // namespace limber::scene
