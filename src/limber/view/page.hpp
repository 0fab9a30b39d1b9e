// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>

#include "limber/view/recording.hpp"

namespace limber::view {

/// The page without data, a product of the build: beside Limber's own file, in
/// ../share/limber from there, or where Limber was configured to be installed.
/// @throws InputError if it does not exist.
std::filesystem::path find_template();

/// Writes one HTML file that shows results in a browser, without a network.
/// @param recordings the first is shown, others are its ghosts
/// @throws InputError if the page without data does not exist, or the file
/// cannot be written.
void write_page(const std::filesystem::path& file,
                std::span<const Recording> recordings);

}  // namespace limber::view
