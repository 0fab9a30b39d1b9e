// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "app/commands.hpp"
#include "app/exit_status.hpp"

namespace {

/// Help goes to standard output; a wrong command line is bad input.
int finish_parse(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return app.exit(error);
  fmt::print(stderr, "limber: error: {} (see limber --help)\n", error.what());
  return limber::app::kBadInput;
}

}  // namespace

int main(int argc, char** argv) {
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
    return finish_parse(app, error);
  }
  return limber::app::run_guarded(action);
}
