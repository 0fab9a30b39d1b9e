// SPDX-License-Identifier: BSD-3-Clause
#include "limber/verifier/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>

#include "limber/app/console/terminal.hpp"
#include "limber/app/console/text_file.hpp"
#include "limber/app/options/reducer.hpp"
#include "limber/app/run/output_folder.hpp"
#include "limber/common/errors.hpp"
#include "limber/runs/unused_cache.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "limber/verifier/stiffening_report.hpp"
#include "limber/verifier/verification_report.hpp"

namespace limber::app {
namespace {

/// What the command line puts in place of the file's word.
void apply(const VerifyOptions& options,
           dynamics::SimulationSettings& settings) {
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

scene::BuiltScene build(const scene::Scene& scene,
                        const VerifyOptions& options) {
  scene::BuiltScene built = scene::build_system(
      scene, make_reducer(make_progress_bar()), options.cache);
  runs::warn_of_unused_cache(options.cache, built);
  clear_progress_bar();
  print_warnings(built.warnings);
  return built;
}

reference::JointModel find_joint_model(const VerifyOptions& options) {
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
void write_reports(const VerifyOptions& options, const Folder& folder,
                   const Report& report, const Draw& draw_in) {
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

void stiffen(const VerifyOptions& options, const Folder& folder,
             const scene::Scene& scene, const scene::BuiltScene& built,
             const VerificationReport& common) {
  StiffeningReport report;
  report.common = common;
  report.factors = options.stiffen;
  report.study = reference::verify_stiffened(
      scene, built, options.stiffen, common.options, make_progress_bar());
  write_reports(options, folder, report,
                [&](const std::filesystem::path& place) {
                  return draw(report, place / "stiffness.png");
                });
}

}  // namespace

void verify(const VerifyOptions& options) {
  Folder folder;
  if (!options.out.empty()) folder.emplace(options.out);
  VerificationReport report;
  report.scenario = options.scenario;
  report.options.simbody.joints = find_joint_model(options);
  report.options.simbody.accuracy = options.accuracy;
  report.options.refinements = options.refine;
  scene::Overrides overrides;
  overrides.fidelity = dynamics::Fidelity::rigid;
  overrides.settings = to_settings(options.robots);
  scene::Scene scene = scene::load_scene(options.scenario, overrides);
  apply(options, scene.scenario.settings);
  if (options.refine > 0 && scene.scenario.settings.tolerance > 0.0) {
    throw InputError(
        "--refine halves steps, and the scenario has a tolerance instead of a "
        "step; also give --step");
  }
  if (options.refine > 0 && !options.stiffen.empty()) {
    throw InputError(
        "--refine and --stiffen are two studies; choose one at a time");
  }
  report.integrator = scene.scenario.settings.integrator;
  const scene::BuiltScene built = build(scene, options);
  report.tolerance = built.settings.tolerance;
  if (options.joints.empty() && has_ideal_joints(built.model)) {
    report.options.simbody.joints = reference::JointModel::ideal;
  }
  if (!options.stiffen.empty()) {
    stiffen(options, folder, scene, built, report);
    return;
  }
  report.result =
      reference::verify(scene, built, report.options, make_progress_bar());
  write_reports(options, folder, report,
                [](const std::filesystem::path&) { return std::string(); });
}

}  // namespace limber::app
