// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

namespace limber::results {

/// How a gnuplot process ended.
enum class GnuplotEnd { done, failed, missing, hung };

/// Runs `gnuplot` on a script and waits at most `limit` for its end; then it is
/// killed with all its children. Its output is discarded, and it is killed if
/// this process ends.
[[nodiscard]] GnuplotEnd run_gnuplot(const std::string& script,
                                     std::chrono::milliseconds limit);

}  // namespace limber::results
