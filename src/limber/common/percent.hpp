// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace limber {

/// "1.2 %"; "none" without a value. @param fraction [-]
[[nodiscard]] std::string to_percent(std::optional<double> fraction);

}  // namespace limber
