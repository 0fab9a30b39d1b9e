// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "limber/app/commands/commands.hpp"
#include "limber/app/options/shared_options.hpp"
#include "limber/app/reports/explanation.hpp"

namespace limber::app {
namespace {

struct ExplainOptions {
  std::string folder;
  bool json = false;
};

}  // namespace

void add_explain(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ExplainOptions>();
  CLI::App* command = app.add_subcommand(
      "explain",
      "Report what limited the steps of a run, its events, where time and "
      "energy went, and what to try");
  command->add_option("folder", options->folder, "Results folder of a run")
      ->required();
  add_json(*command, options->json);
  command->callback([&action, options] {
    action = [options] {
      const RunSummary run = read_run_summary(options->folder);
      fmt::print("{}",
                 options->json ? to_text(explain(run)) + "\n" : to_text(run));
    };
  });
}

}  // namespace limber::app
