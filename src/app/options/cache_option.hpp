// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace limber::app {

/// --cache FOLDER, the folder of reduced bodies; empty: the default one.
CLI::Option* add_cache_option(CLI::App& command, std::string& folder);

}  // namespace limber::app
