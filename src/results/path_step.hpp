// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limber::results {

/// `name` as a single step of a path, in an HDF5 file or a folder: a slash
/// becomes "%2F", a lone dot "%2E" and a percent sign "%25", as in addresses of
/// the web. Different names stay different.
[[nodiscard]] std::string to_path_step(const std::string& name);

/// The name that `to_path_step` was given.
[[nodiscard]] std::string from_path_step(const std::string& step);

}  // namespace limber::results
