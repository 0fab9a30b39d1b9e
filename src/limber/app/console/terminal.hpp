// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/common/progress.hpp"

namespace limber::app {

/// A progress bar if standard error is a terminal; else a line if work will be
/// long.
[[nodiscard]] Progress make_progress_bar();

/// Passes reports to `bar` from a second after this call on, if standard error
/// is a terminal: for work that is mostly short.
[[nodiscard]] Progress delay_progress(const Progress& bar);

/// Removes the bar, so that other lines can follow.
void clear_progress_bar();

/// "limber: error: ..." on standard error, control characters escaped. Failures
/// to write there are ignored.
void print_error(const std::string& text) noexcept;

/// The same without "error: ".
void print_notice(const std::string& text) noexcept;

/// "limber: note: ..." lines likewise.
void print_notes(const std::vector<std::string>& notes);

/// "limber: warning: ..." lines likewise.
void print_warnings(const std::vector<std::string>& warnings);

}  // namespace limber::app
