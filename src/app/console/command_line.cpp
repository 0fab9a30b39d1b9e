// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/console/command_line.hpp"

#include <CLI/CLI.hpp>
#include <string>

#include "limber/app/console/exit_status.hpp"
#include "limber/app/console/process.hpp"
#include "limber/app/console/terminal.hpp"
#include "limber/common/echo.hpp"
#include "limber/version.hpp"

namespace limber::app {
namespace {

/// Help goes to standard output; a wrong command line is bad input.
int finish_parse(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) {
    return run_guarded([&] { (void)app.exit(error); });
  }
  constexpr std::size_t kUsual = 1000;  // all but what echoes long words
  const std::string text = error.what();
  print_error((text.size() > kUsual ? echo(text) : text) +
              " (see limber --help)");
  return kBadInput;
}

}  // namespace

int run_command_line(int argc, char** argv, const AddCommands& add_commands) {
  prepare_process();
  check_stack();
  check_address_space();
  CLI::App app("Simulates arms that bend.", "limber");
  app.set_version_flag("--version", LIMBER_VERSION);
  app.require_subcommand(1);
  Action action;
  add_commands(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return end_process(finish_parse(app, error));
  }
  return end_process(run_guarded(action));
}

}  // namespace limber::app
