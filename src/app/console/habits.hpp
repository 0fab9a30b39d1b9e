// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

namespace CLI {
class App;
}

namespace limber::app {

/// What every command understands.
struct HabitFlags {
  bool quiet = false;
  bool verbose = false;
};
using Habits = std::shared_ptr<HabitFlags>;

/// Adds --quiet and --verbose to `limber` and all its commands.
[[nodiscard]] Habits add_habits(CLI::App& app);

/// After the command line was read: quiet, a command that leaves its results in
/// files prints no summary of them; an answer that is nowhere else, and --json,
/// are printed.
/// @throws InputError for both flags
void follow_habits(const CLI::App& app, const HabitFlags& habits);

/// Time and memory of this process, if verbose.
void print_cost();

}  // namespace limber::app
