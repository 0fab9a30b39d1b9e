// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

namespace CLI {
class App;
}

namespace limber::app {

/// Options that every command has.
struct HabitFlags {
  bool quiet = false;
  bool verbose = false;
};
using Habits = std::shared_ptr<HabitFlags>;

/// Adds --quiet and --verbose to `limber` and all its commands.
[[nodiscard]] Habits add_habits(CLI::App& app);

/// To be called after the command line was read. With --quiet a command whose
/// results are in files prints no summary; answers that are in no file, and
/// --json, are printed.
/// @throws InputError for both flags
void follow_habits(const CLI::App& app, const HabitFlags& habits);

/// Prints time and memory of this process, if verbose.
void print_cost();

}  // namespace limber::app
