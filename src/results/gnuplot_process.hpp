// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

namespace limber::results {

/// How a gnuplot ended.
enum class GnuplotEnd { done, failed, missing, hung };

/// Runs `gnuplot` on a script and waits for its end, for so long at most; then
/// it is killed with all that it started. Its own output is dropped, and it
/// ends with this process, however that ends.
[[nodiscard]] GnuplotEnd run_gnuplot(const std::string& script,
                                     std::chrono::milliseconds limit);

}  // namespace limber::results
