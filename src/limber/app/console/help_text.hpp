// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limber::app {

/// Version, compiler and options of the build: `limber --version`.
[[nodiscard]] std::string describe_build();

/// An entry for BibTeX: `limber --cite`.
[[nodiscard]] std::string describe_citation();

/// Environment and exit status, for `limber --help` and its manual page.
[[nodiscard]] std::string describe_surroundings();

}  // namespace limber::app
