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

/// "limber: error: ..." on standard error, control characters spelt out. Like
/// all that goes there it is no matter if nobody can read it.
void print_error(const std::string& text) noexcept;

/// The same without "error: ".
void print_notice(const std::string& text) noexcept;

/// "limber: warning: ..." lines likewise.
void print_warnings(const std::vector<std::string>& warnings);

}  // namespace limber::app
