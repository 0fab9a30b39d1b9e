// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limber/app/run/output_folder.hpp"
#include "limber/view/recording.hpp"

namespace limber::app {

/// @throws as view::read_recording
[[nodiscard]] std::vector<view::Recording> read_recordings(
    const std::vector<std::filesystem::path>& results);

/// Adds view.html to a results folder as one of its files, so that a later run
/// there removes it.
/// @returns the file
/// @throws as view::write_page
std::filesystem::path add_view_to(
    const OutputFolder& folder, const std::vector<view::Recording>& recordings);

/// One line with the file and its size.
[[nodiscard]] std::string describe_view(const std::filesystem::path& page);

}  // namespace limber::app
