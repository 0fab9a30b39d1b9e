// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limber::bench {

/// Words of a refusal that tell its kind: names and numbers left out.
[[nodiscard]] std::string find_kind(const std::string& text);

}  // namespace limber::bench
