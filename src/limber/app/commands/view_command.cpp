// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "limber/app/commands/commands.hpp"
#include "limber/app/console/terminal.hpp"
#include "limber/app/options/scene_loading.hpp"
#include "limber/app/options/shared_options.hpp"
#include "limber/app/run/output_folder.hpp"
#include "limber/app/run/play_scene.hpp"
#include "limber/app/run/view_page.hpp"
#include "limber/common/errors.hpp"
#include "limber/view/page.hpp"
#include "limber/view/recording.hpp"

namespace limber::app {
namespace {

struct ViewOptions {
  std::vector<std::string> results;  // the first is shown
  std::vector<std::string> ghosts;
  std::string out;
  std::string play;  // a scenario, in place of results
  std::string cache;
};

/// Runs of a comparison, the reference first; none if it is not one.
std::vector<std::filesystem::path> find_compared(
    const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> runs;
  if (!std::filesystem::is_regular_file(folder / "comparison.json")) return {};
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (std::filesystem::is_regular_file(entry.path() / "results.h5")) {
      runs.push_back(entry.path());
    }
  }
  if (runs.empty()) {
    throw InputError(
        fmt::format("'{}' is a comparison that kept no runs to show; run it "
                    "again with `limber compare --keep`",
                    folder.string()));
  }
  std::sort(runs.begin(), runs.end());
  std::stable_partition(runs.begin(), runs.end(), [](const auto& run) {
    return run.filename() == "reference";
  });
  return runs;
}

/// Its page would replace the results.
void check_page(const std::filesystem::path& page,
                const std::vector<std::filesystem::path>& results) {
  for (const std::filesystem::path& one : results) {
    std::error_code unknown;
    if (!std::filesystem::equivalent(page, view::find_results(one), unknown)) {
      continue;
    }
    throw InputError(fmt::format(
        "-o {}: the page would replace the results; choose another name",
        page.string()));
  }
}

void show(const ViewOptions& options) {
  const std::string& shown = options.results.front();
  std::vector<std::filesystem::path> all = find_compared(shown);
  if (all.empty()) all.emplace_back(shown);
  all.insert(all.end(), options.results.begin() + 1, options.results.end());
  all.insert(all.end(), options.ghosts.begin(), options.ghosts.end());
  const std::vector<view::Recording> recordings = read_recordings(all);
  std::filesystem::path page = options.out;
  if (page.empty()) {
    const std::filesystem::path given = std::filesystem::absolute(shown);
    const std::filesystem::path folder =
        std::filesystem::is_directory(given) ? given : given.parent_path();
    page = add_view_to(OutputFolder(folder), recordings);
  } else {
    check_page(page, all);
    view::write_page(page, recordings);
  }
  fmt::print("{}\n", describe_view(page));
}

void play(const ViewOptions& options) {
  const scene::Scene scene = load_with_notes(options.play, {});
  const view::Playground playground =
      make_playground(scene, options.cache, make_progress_bar());
  clear_progress_bar();
  const std::filesystem::path page =
      options.out.empty() ? scene.scenario.name + ".html" : options.out;
  view::write_play_page(page, playground);
  fmt::print("{}\n", describe_view(page));
}

}  // namespace

void add_view(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ViewOptions>();
  CLI::App* command = app.add_subcommand(
      "view", "Show results in a browser: one HTML file, without a network");
  CLI::Option* results = command->add_option(
      "results", options->results,
      "Folder of a run or of a comparison, or its results.h5; further ones are "
      "shown as ghosts, or side by side (key b in the page)");
  CLI::Option* ghosts =
      command->add_option("--with", options->ghosts,
                          "Other results, shown as ghosts (may be repeated)");
  command
      ->add_option("--play", options->play,
                   "Instead of results, a scenario that the page simulates "
                   "itself, with sliders for its values")
      ->excludes(results)
      ->excludes(ghosts);
  add_cache_option(*command, options->cache)->needs("--play");
  command->add_option("-o,--out", options->out,
                      "The file (default: view.html in the folder; with --play "
                      "the scenario's name with .html, here)");
  command->callback([&action, options] {
    if (options->results.empty() && options->play.empty()) {
      throw CLI::RequiredError("results, or --play SCENARIO");
    }
    action = [options] {
      options->play.empty() ? show(*options) : play(*options);
    };
  });
}

}  // namespace limber::app
