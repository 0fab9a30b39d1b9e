// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "limber/dynamics/equations/motion_scale.hpp"
#include "limber/scene/build/build_system.hpp"

/// Steps to a tolerance held against fixed steps.
namespace limber::bench::tolerance {

/// One run, observed at the outputs that all runs of its scene share.
struct Run {
  std::vector<dynamics::SystemState> states;
  dynamics::SimulationStatistics statistics;
  double seconds = 0.0;  ///< of the processor
  std::string stopped;   ///< why it ended early, or empty

  /// Including rejected steps.
  [[nodiscard]] long steps() const {
    return statistics.steps + statistics.rejected_steps;
  }
};

/// A fixed-step run and how far it is off the reference.
struct Rung {
  double step = 0.0;  ///< the longest [s]
  Run run;
  double error = std::numeric_limits<double>::infinity();  ///< [m]
};

/// A scene at level `coupled`, simulated again and again. All runs have the
/// same outputs, 100 equal intervals, so that those do not limit fixed steps
/// much.
class SceneRuns {
 public:
  /// @param file below the source folder @param cache folder of reduced bodies
  SceneRuns(const std::string& file, const std::filesystem::path& cache);

  [[nodiscard]] const std::string& name() const { return name_; }
  /// Longest step of the file's own fixed steps [s]; whether it changes.
  [[nodiscard]] double own_step() const;
  [[nodiscard]] bool has_own_changes() const {
    return !built_.settings.step_changes.empty();
  }
  [[nodiscard]] double span() const;  ///< of time [s]

  [[nodiscard]] Run run_to(double tolerance,
                           dynamics::TolerancePasses passes) const;
  [[nodiscard]] Run run_fixed(double step) const;
  /// In the file's own steps, all times such a factor that the longest is
  /// `longest` [s].
  [[nodiscard]] Run run_own_steps(double longest) const;

  /// Largest distance of any point at any output [m]; infinity if one of the
  /// runs stopped.
  [[nodiscard]] double measure_distance(const Run& a, const Run& b) const;
  /// Largest distance from the start [m].
  [[nodiscard]] double measure_motion(const Run& run) const;

 private:
  [[nodiscard]] Run run(const dynamics::SimulationSettings& settings) const;

  std::string name_;
  scene::BuiltScene built_;
  dynamics::MotionScale scale_;
};

/// What all other runs of a scene are held against.
struct Reference {
  Run run;
  std::string kind;          ///< how it was made
  double uncertainty = 0.0;  ///< its own estimate of its error [m]
  double from_other = 0.0;   ///< distance of a second one, made otherwise [m]
  double other_uncertainty = 0.0;  ///< [m]
  std::vector<Rung> ladder;  ///< of uniform steps, each half the one before
};

/// The better, by its own estimate, of ever finer uniform steps (a third of the
/// difference of the last two) and a tolerance far below `smallest` [m].
[[nodiscard]] Reference find_reference(const SceneRuns& runs, double smallest);

}  // namespace limber::bench::tolerance
