// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>

#include "app/commands.hpp"
#include "app/exit_status.hpp"
#include "app/process.hpp"
#include "app/terminal.hpp"
#include "common/echo.hpp"

namespace {

/// Help goes to standard output; a wrong command line is bad input.
int finish_parse(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) {
    return limber::app::run_guarded([&] { (void)app.exit(error); });
  }
  constexpr std::size_t kUsual = 1000;  // all but what echoes long words
  const std::string text = error.what();
  limber::app::print_error((text.size() > kUsual ? limber::echo(text) : text) +
                           " (see limber --help)");
  return limber::app::kBadInput;
}

}  // namespace

int main(int argc, char** argv) {
  limber::app::prepare_process();
  limber::app::check_stack();
  limber::app::check_address_space();
  CLI::App app("Simulates arms that bend.", "limber");
  app.set_version_flag("--version", LIMBER_VERSION);
  app.require_subcommand(1);
  limber::app::Action action;
  limber::app::add_run(app, action);
  limber::app::add_advise(app, action);
  limber::app::add_compare(app, action);
  limber::app::add_verify(app, action);
  limber::app::add_modes(app, action);
  limber::app::add_frequencies(app, action);
  limber::app::add_static(app, action);
  limber::app::add_operate(app, action);
  limber::app::add_reduce(app, action);
  limber::app::add_info(app, action);
  limber::app::add_wobble(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return limber::app::end_process(finish_parse(app, error));
  }
  return limber::app::end_process(limber::app::run_guarded(action));
}
