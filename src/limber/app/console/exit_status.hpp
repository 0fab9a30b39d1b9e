// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

namespace limber::app {

enum ExitStatus { kSuccess = 0, kBadInput = 2, kNoSolution = 3, kDefect = 70 };

/// Runs `work` and returns the exit status. The only place that turns an
/// exception, or a failure to write standard output, into lines "limber: error:
/// ..." on standard error and a status. A run ended by a signal returns 128
/// plus the signal's number.
[[nodiscard]] int run_guarded(const std::function<void()>& work);

}  // namespace limber::app
