// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace limber::app {

/// Runs the chosen subcommand once the command line is read.
using Action = std::function<void()>;

/// Adds subcommands; choosing one sets the action.
using AddCommands = std::function<void(CLI::App&, Action&)>;

/// Reads the command line of `limber` and runs it, in a process prepared by
/// prepare_process. @return exit status
[[nodiscard]] int run_command_line(int argc, char** argv,
                                   const AddCommands& add_commands);

}  // namespace limber::app
