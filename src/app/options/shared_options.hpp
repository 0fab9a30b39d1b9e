// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

/// Options that several commands have.
namespace limber::app {

/// The scenario's file, required.
CLI::Option* add_scenario(CLI::App& command, std::string& file);

/// --fidelity LEVEL, of every flexible link.
CLI::Option* add_fidelity(CLI::App& command, std::optional<std::string>& level);

/// --cache FOLDER, the folder of reduced bodies; empty: the default one.
CLI::Option* add_cache_option(CLI::App& command, std::string& folder);

/// --json
CLI::Option* add_json(CLI::App& command, bool& is_asked);

}  // namespace limber::app
