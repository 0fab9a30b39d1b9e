// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

namespace CLI {
class App;
}

namespace limber::app {

/// Options that every command has.
struct GlobalFlags {
  bool quiet = false;
  bool verbose = false;
};
using SharedGlobalFlags = std::shared_ptr<GlobalFlags>;

/// Adds --quiet and --verbose to `limber` and all its commands.
[[nodiscard]] SharedGlobalFlags add_global_flags(CLI::App& app);

/// To be called after the command line was read. With --quiet a command whose
/// results are in files prints no summary; answers that are in no file, and
/// --json, are printed.
/// @throws InputError for both flags
void follow_global_flags(const CLI::App& app, const GlobalFlags& flags);

/// Prints time and memory of this process, if verbose.
void print_cost();

}  // namespace limber::app
