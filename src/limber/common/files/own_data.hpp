// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <string>

namespace limber {

/// Where data that came with Limber may be, by name: beside its own file
/// (files/own_file.hpp), in ../share/limber from there, or where Limber was
/// configured to be installed.
[[nodiscard]] std::array<std::filesystem::path, 3> list_data_places(
    const std::string& name);

/// The first of these places that exists; empty if none does.
[[nodiscard]] std::filesystem::path find_own_data(const std::string& name);

}  // namespace limber
