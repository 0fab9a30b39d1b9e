// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
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

/// --out FOLDER, a command's results. The help text names the default in the
/// folder `out`: "<scenario name>-advise".
CLI::Option* add_out(CLI::App& command, std::string& folder,
                     const std::string& default_name);

/// The folder given by --out, else the folder of this name in `out`.
std::filesystem::path find_results_folder(const std::string& out,
                                          const std::string& default_name);

/// --unit of a mesh: a name or a number [m]; `metres` stays without it.
CLI::Option* add_unit(CLI::App& command, double& metres);

/// --force-unit of a deck's materials: a name or a number [N]; `newtons` stays
/// without it.
CLI::Option* add_force_unit(CLI::App& command, double& newtons);

/// --json
CLI::Option* add_json(CLI::App& command, bool& is_requested);

}  // namespace limber::app
