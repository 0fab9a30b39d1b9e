// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "limber/app/commands/commands.hpp"
#include "limber/app/scenario_schema.hpp"

namespace limber::app {

void add_schema(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "schema",
      "Print the JSON Schema of scenarios, by which editors complete and check "
      "keys");
  command->callback(
      [&action] { action = [] { fmt::print("{}", kScenarioSchema); }; });
}

}  // namespace limber::app
