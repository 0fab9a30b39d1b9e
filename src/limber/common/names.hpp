// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace limber {

/// The known name nearest to `unknown` by edit distance, or an empty string if
/// none is near enough to be a likely typing error.
[[nodiscard]] std::string nearest_name(std::string_view unknown,
                                       const std::vector<std::string>& known);

/// Least number of letters to add, remove or replace that makes one the other.
[[nodiscard]] std::size_t find_edit_distance(std::string_view a,
                                             std::string_view b);

/// "unknown KIND 'NAME'" with a suggestion and the known names (the first ones
/// if there are many).
[[nodiscard]] std::string describe_unknown(
    std::string_view kind, std::string_view name,
    const std::vector<std::string>& known);

/// Index of `name` in `known`. @throws InputError with describe_unknown's text.
[[nodiscard]] std::size_t find_name(std::string_view kind,
                                    std::string_view name,
                                    const std::vector<std::string>& known);

}  // namespace limber
