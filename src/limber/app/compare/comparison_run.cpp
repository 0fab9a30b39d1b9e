// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/compare/comparison_run.hpp"

#include "limber/app/console/terminal.hpp"
#include "limber/app/options/reducer.hpp"
#include "limber/app/options/scene_loading.hpp"
#include "limber/app/run/output_folder.hpp"
#include "limber/app/run/run_scene.hpp"

namespace limber::app {
namespace {

void keep_run(const std::filesystem::path& folder, const runs::Run& run) {
  OutputFolder(folder).write([&](const std::filesystem::path& place) {
    write_run(run, place, run.scene.scenario.output.xdmf);
    if (has_pictures(run)) draw_run(run, place);
  });
}

}  // namespace

runs::Comparison run_comparison(const runs::ComparisonPlan& plan,
                                const ComparisonRequest& request) {
  runs::ComparisonSettings settings;
  settings.scenario = request.scenario;
  settings.settings = request.settings;
  settings.make_reductions = [&](const Progress& progress) {
    return make_reductions(request.cache, progress);
  };
  settings.judges_levels = request.keep_runs;
  settings.repeats = request.repeats;
  settings.progress = make_progress_bar();
  settings.watch = request.watch;
  settings.note = [](const scene::Scene& scene, const std::string& text) {
    clear_progress_bar();
    print_more_notes(scene, {text});
  };
  settings.warn = [](const std::string& text) {
    clear_progress_bar();
    print_warnings({text});
  };
  if (request.keep_runs) {
    settings.keep = [&](const runs::Choice& choice, const runs::Run& run) {
      clear_progress_bar();
      keep_run(request.folder / (choice == plan.reference
                                     ? "reference"
                                     : make_folder_name(choice)),
               run);
    };
  }
  runs::Comparison comparison = compare_runs(plan, settings);
  clear_progress_bar();
  return comparison;
}

}  // namespace limber::app
