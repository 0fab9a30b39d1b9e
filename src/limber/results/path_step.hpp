// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limber::results {

/// `name` as a single path component, in an HDF5 file or a folder: a slash
/// becomes "%2F", a lone dot "%2E" and a percent sign "%25", as in URLs.
/// Different names remain different.
[[nodiscard]] std::string to_path_step(const std::string& name);

/// Inverse of `to_path_step`.
[[nodiscard]] std::string from_path_step(const std::string& step);

}  // namespace limber::results
