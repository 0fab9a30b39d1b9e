// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limber::bench {

/// The kind of an error: its message without names and numbers.
[[nodiscard]] std::string find_kind(const std::string& text);

}  // namespace limber::bench
