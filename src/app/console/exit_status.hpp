// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

namespace limber::app {

enum ExitStatus { kSuccess = 0, kBadInput = 2, kNoSolution = 3, kDefect = 70 };

/// Runs `work`. An exception becomes lines "limber: error: ..." on standard
/// error and its exit status, the one place where that happens; so does
/// standard output that cannot be written. A run that a signal ended has 128
/// and the signal's number.
[[nodiscard]] int run_guarded(const std::function<void()>& work);

}  // namespace limber::app
