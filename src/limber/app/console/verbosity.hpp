// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber::app {

/// Amount of text on standard error.
enum class Verbosity {
  quiet,   ///< errors and warnings
  usual,   ///< and progress
  verbose  ///< and each step of the work with its time
};

/// Sets it for this process, from now on.
void set_verbosity(Verbosity verbosity);
[[nodiscard]] Verbosity find_verbosity();

}  // namespace limber::app
