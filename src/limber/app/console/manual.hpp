// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace CLI {
class App;
}

namespace limber::app {

/// The manual page of a command (man(7), section 1), with the texts of its
/// --help.
/// @param app the command itself, or `limber`
[[nodiscard]] std::string to_manual(const CLI::App& app);

/// Writes limber.1 and those of all its commands, such as limber-run.1.
/// @throws InputError if the folder cannot be written.
void write_manuals(const CLI::App& app, const std::filesystem::path& folder);

}  // namespace limber::app
