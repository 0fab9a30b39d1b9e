// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace limber::view {

/// SHA-256 of the sources that the module of playgrounds is compiled of, as
/// this command has them (cmake/playground_sources.cmake).
[[nodiscard]] std::string_view playground_digest();

}  // namespace limber::view
