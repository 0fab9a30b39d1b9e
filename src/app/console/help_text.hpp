// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limber::app {

/// Version, compiler and options of the build: `limber --version`.
[[nodiscard]] std::string describe_build();

/// What ends `limber --help` and its manual page: environment and exit status.
[[nodiscard]] std::string describe_surroundings();

}  // namespace limber::app
