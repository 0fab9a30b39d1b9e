// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "limber/app/run/run_scene.hpp"
#include "limber/common/progress.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/scene_robots.hpp"
#include "limber/study/study_file.hpp"

namespace limber::app {

/// Makes runs of a study, in any number of threads. Scenes are loaded one at a
/// time, because the libraries for it are not thread-safe; each distinct
/// reduction is done once, and a robot is read once for the same settings.
class StudyWorker {
 public:
  /// @param study must outlive the worker
  /// @param cache empty for the default one
  /// @param known bodies that need no reduction
  /// @param watch called during runs; may throw to end one
  StudyWorker(const study::Study& study, std::filesystem::path cache,
              scene::KnownParts known, Progress watch);

  /// The row of one run without its formulas (evaluate_formulas). The row of a
  /// run that fails has its message.
  /// @param factors the run's values, as TOML
  /// @returns none if `watch` ended it with dynamics::Interrupted
  [[nodiscard]] std::optional<study::StudyRow> make_row(
      std::size_t run, const std::vector<std::string>& factors);

 private:
  [[nodiscard]] bool simulate(study::StudyRow& row);
  [[nodiscard]] runs::Run make_run(
      study::StudyRow& row, const std::optional<dynamics::Fidelity>& level);

  const study::Study& study_;
  std::filesystem::path cache_;
  Progress watch_;
  bool judges_;

  // To be used only while libraries are locked:
  scene::KnownParts known_;
  scene::KnownRobots robots_;
  scene::Reducer reducer_;
};

}  // namespace limber::app
