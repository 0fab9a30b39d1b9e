// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "app/commands.hpp"
#include "app/output_folder.hpp"
#include "app/reducer.hpp"
#include "app/stiffening_report.hpp"
#include "app/terminal.hpp"
#include "app/text_file.hpp"
#include "app/validators.hpp"
#include "app/verification_report.hpp"
#include "common/errors.hpp"

namespace limber::app {
namespace {

struct Options {
  std::string scenario;
  std::string joints;
  std::string integrator;
  std::string cache;
  double step = 0.0;
  double duration = 0.0;
  double accuracy = 1e-12;
  int refine = 0;
  std::vector<double> stiffen;
  std::string out;
  bool json = false;
};

#ifdef LIMBER_HAS_REFERENCE

/// What the command line puts in place of the file's word.
void apply(const Options& options, dynamics::SimulationSettings& settings) {
  if (!options.integrator.empty()) {
    settings.integrator = dynamics::parse_integrator(options.integrator);
  }
  if (options.step > 0.0) {
    settings.step = options.step;
    settings.tolerance = 0.0;
    settings.step_changes.clear();
  }
  if (options.duration > 0.0) {
    settings.end_time = options.duration;
    std::erase_if(settings.output_times,
                  [&](double t) { return t > options.duration; });
  }
}

scene::BuiltScene build(const scene::Scene& scene, const Options& options) {
  scene::BuiltScene built = scene::build_system(
      scene, make_reducer(make_progress_bar()), options.cache);
  clear_progress_bar();
  print_warnings(built.warnings);
  return built;
}

reference::JointModel find_joint_model(const Options& options) {
  if (!options.joints.empty()) {
    return reference::parse_joint_model(options.joints);
  }
  return options.stiffen.empty() ? reference::JointModel::bushings
                                 : reference::JointModel::ideal;
}

/// Where a report goes, if anywhere.
using Folder = std::optional<OutputFolder>;

/// Writes a report and its picture if there is a folder for it, and prints it.
/// @param draw_in draws in a folder, and says why there is no picture if so
template <typename Report, typename Draw>
void tell(const Options& options, const Folder& folder, const Report& report,
          const Draw& draw_in) {
  clear_progress_bar();
  const Json json = to_json(report);
  if (folder) {
    folder->write([&](const std::filesystem::path& place) {
      write_text(place / "verification.json", to_text(json));
      const std::string why = draw_in(place);
      if (!why.empty()) print_warnings({why});
    });
  }
  fmt::print("{}\n", options.json ? to_text(json) : to_text(report));
}

void stiffen(const Options& options, const Folder& folder,
             const scene::Scene& scene, const scene::BuiltScene& built,
             const VerificationReport& common) {
  StiffeningReport report;
  report.common = common;
  report.factors = options.stiffen;
  report.study = reference::verify_stiffened(
      scene, built, options.stiffen, common.options, make_progress_bar());
  tell(options, folder, report, [&](const std::filesystem::path& place) {
    return draw(report, place / "stiffness.png");
  });
}

void verify(const Options& options) {
  Folder folder;
  if (!options.out.empty()) folder.emplace(options.out);
  VerificationReport report;
  report.scenario = options.scenario;
  report.options.witness.joints = find_joint_model(options);
  report.options.witness.accuracy = options.accuracy;
  report.options.refinements = options.refine;
  scene::Overrides overrides;
  overrides.fidelity = dynamics::Fidelity::rigid;
  scene::Scene scene = scene::load_scene(options.scenario, overrides);
  apply(options, scene.scenario.settings);
  if (options.refine > 0 && scene.scenario.settings.tolerance > 0.0) {
    throw InputError(
        "--refine halves steps, and the scenario has a tolerance in place of "
        "them; give --step, too");
  }
  if (options.refine > 0 && !options.stiffen.empty()) {
    throw InputError(
        "--refine and --stiffen are two studies; ask for one at a time");
  }
  report.integrator = scene.scenario.settings.integrator;
  const scene::BuiltScene built = build(scene, options);
  if (!options.stiffen.empty()) {
    stiffen(options, folder, scene, built, report);
    return;
  }
  report.result =
      reference::verify(scene, built, report.options, make_progress_bar());
  tell(options, folder, report,
       [](const std::filesystem::path&) { return std::string(); });
}

#else

void verify(const Options& /*options*/) {
  throw InputError(
      "verify: this limber was built without Simbody (LIMBER_REFERENCE=OFF); "
      "build with -DLIMBER_REFERENCE=ON");
}

#endif

}  // namespace

void add_verify(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "verify", "Compare the level `rigid` with Simbody, body by body");
  command->add_option("scenario", options->scenario, "Scenario file (TOML)")
      ->required();
  command->add_option("--joints", options->joints,
                      "What stands for joints in Simbody: bushings (default), "
                      "linear-bushings, ideal");
  command->add_option("--step", options->step, "Our longest step [s]")
      ->check(make_positive());
  command->add_option("--duration", options->duration, "End of both runs [s]")
      ->check(make_positive());
  command->add_option("--integrator", options->integrator,
                      "Ours: generalized-alpha, runge-kutta-4, "
                      "explicit-euler");
  command->add_option("--accuracy", options->accuracy,
                      "Of Simbody's integrator (default 1e-12)");
  command
      ->add_option("--refine", options->refine,
                   "Halve our step this often; shows the order")
      ->check(CLI::Range(0, 20));
  command
      ->add_option("--stiffen", options->stiffen,
                   "Factors of what all joints hold, as in 1,10,100: how our "
                   "joints become Simbody's ideal ones")
      ->delimiter(',')
      ->check(make_positive());
  command->add_option("--out", options->out,
                      "Folder for verification.json and, with --stiffen, "
                      "stiffness.png (default: none)");
  command->add_option("--cache", options->cache, "Folder of reduced bodies");
  command->add_flag("--json", options->json, "Print one JSON object");
  command->callback(
      [&action, options] { action = [options] { verify(*options); }; });
}

}  // namespace limber::app
