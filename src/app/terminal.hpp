// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "common/progress.hpp"

namespace limber::app {

/// A bar on standard error if that is a terminal; a line if work will be long.
[[nodiscard]] Progress make_progress_bar();

/// Removes the bar, so that other lines can follow.
void clear_progress_bar();

/// "limber: warning: ..." lines on standard error.
void print_warnings(const std::vector<std::string>& warnings);

}  // namespace limber::app
