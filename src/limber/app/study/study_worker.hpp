// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "limber/app/run/run_scene.hpp"
#include "limber/app/study/study_file.hpp"
#include "limber/common/progress.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/scene_robots.hpp"

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
  StudyWorker(const Study& study, std::filesystem::path cache,
              scene::KnownParts known, Progress watch);

  /// The row of one run without its formulas (evaluate_formulas). The row of a
  /// run that fails has its message.
  /// @param factors the run's values, as TOML
  /// @returns none if `watch` ended it with dynamics::Interrupted
  [[nodiscard]] std::optional<StudyRow> make_row(
      std::size_t run, const std::vector<std::string>& factors);

 private:
  [[nodiscard]] bool simulate(StudyRow& row);
  [[nodiscard]] runs::Run make_run(
      StudyRow& row, const std::optional<dynamics::Fidelity>& level);

  const Study& study_;
  std::filesystem::path cache_;
  Progress watch_;
  bool judges_;

  // To be used only while libraries are locked:
  scene::KnownParts known_;
  scene::KnownRobots robots_;
  scene::Reducer reducer_;
};

}  // namespace limber::app
