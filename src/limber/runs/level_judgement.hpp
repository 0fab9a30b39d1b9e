// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "limber/common/progress.hpp"
#include "limber/dynamics/analysis/level_advice.hpp"
#include "limber/dynamics/monitors/followed.hpp"
#include "limber/dynamics/monitors/impact_spectrum.hpp"
#include "limber/runs/reductions.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/scene.hpp"

/// The level of each flexible body: used and recommended.
namespace limber::runs {

struct BodyLevel {
  std::string name;
  dynamics::Fidelity used = dynamics::Fidelity::coupled;  ///< or requested
  dynamics::BodyPeaks peaks;
  dynamics::LevelLimits limits;
  dynamics::LevelAdvice advice;
  std::shared_ptr<const flexbody::ReducedBody> reduced;
  std::vector<dynamics::RotationPoint> track;
  /// Of rotation; set only by find_bounds, since it is expensive.
  std::shared_ptr<const flexbody::InertialDisplacementBound> bound;
  /// For each pair in which it touches another body; set only by advise_scene.
  std::vector<dynamics::ImpactSpectrum> impacts;
  /// Why the figures have no stated error; empty if they have. Set only by
  /// advise_scene.
  std::string doubt;

  /// Whether the level used neglects no more than the limits allow.
  [[nodiscard]] bool is_justified() const { return used >= advice.level; }
  [[nodiscard]] bool is_more_than_needed() const { return used > advice.level; }
};

/// Advice on every flexible body that `level_observer` observed.
/// @param model the level_observer's
/// @param used one level a body of the model
[[nodiscard]] std::vector<BodyLevel> judge_levels(
    const dynamics::SystemModel& model,
    const dynamics::LevelObserver& level_observer,
    const std::vector<dynamics::Fidelity>& used,
    const dynamics::AdviceSettings& settings);

/// Observes a run of a scene at every step, to judge whether its levels were
/// justified.
class RunLevelObserver {
 public:
  /// Bodies at level `full` are reduced here. @param scene, built stored by
  /// reference
  RunLevelObserver(const scene::Scene& scene, const scene::BuiltScene& built,
                   const Reductions& reductions);
  RunLevelObserver(const RunLevelObserver&) = delete;
  RunLevelObserver& operator=(const RunLevelObserver&) = delete;
  ~RunLevelObserver() = default;

  /// @returns an observer that refers to this; none if no body is flexible
  [[nodiscard]] std::optional<dynamics::MotionObserver> make_motion_observer();
  void include(const dynamics::SystemState& state);
  [[nodiscard]] std::vector<BodyLevel> judge() const;

 private:
  const scene::Scene& scene_;
  const scene::BuiltScene& built_;
  dynamics::SystemModel model_;  // every flexible body at `uncoupled`
  std::optional<dynamics::LevelObserver> level_observer_;
  dynamics::SystemState framed_;  // with mean frames of full bodies
};

/// The scene with every flexible link at `level`, built with the reduced bodies
/// in `known`; links in `others` at their own levels.
[[nodiscard]] scene::BuiltScene build_at_level(
    const scene::Scene& scene, dynamics::Fidelity level,
    const scene::KnownParts& known, const Reductions& reductions,
    const std::map<std::string, dynamics::Fidelity>& others = {});

/// What `limber advise` finds.
struct SceneAdvice {
  std::string scenario;  ///< its file
  std::vector<BodyLevel> levels;
  std::vector<std::string> warnings;
  std::vector<std::string> notes;  ///< as scene::BuiltScene
};
/// Runs the scene with every link rigid and judges the levels that it requests.
/// @throws InputError also if no link is flexible, or if a controller measures
/// stress
[[nodiscard]] SceneAdvice advise_scene(const scene::Scene& scene,
                                       const Reductions& reductions,
                                       const Progress& progress);

/// Gives free bodies their `bound`.
void find_bounds(std::vector<BodyLevel>& levels);

/// A line for each body whose level was not justified.
[[nodiscard]] std::vector<std::string> find_level_warnings(
    const std::vector<BodyLevel>& levels);

}  // namespace limber::runs
