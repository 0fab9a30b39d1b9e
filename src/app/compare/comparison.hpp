// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/comparison_plan.hpp"
#include "app/json.hpp"
#include "app/run_scene.hpp"
#include "results/motion_error.hpp"

/// What `limber compare` finds: docs/compare.md.
namespace limber::app {

/// Difference of one probe column from the reference, over all output times.
struct ProbeDifference {
  double rms = 0.0;
  double max = 0.0;
  std::string unit;
};

/// What a run costs.
struct Cost {
  double online = 0.0;  ///< wall time per simulated time, the least found [-]
  int repeats = 0;      ///< runs of which it is the least
  /// Wall time of the reductions [s]; none if the cache had one of them.
  std::optional<double> offline;
  long steps = 0;
  long newton_iterations = 0;
  int modes = 0;
};

/// One run of a comparison, without its states.
struct ComparedRun {
  Choice choice;
  Cost cost;
  std::optional<results::SystemMotionError> error;  ///< if it was completed
  std::optional<double> energy_drift;  ///< largest, of the throughput [-]
  std::map<std::string, ProbeDifference> probes;
  std::string stopped;       ///< why and when it ended early, or empty
  results::History history;  ///< probes alone
};

struct Comparison {
  std::filesystem::path scenario;
  std::string reference_note;  ///< describe_default_reference
  ComparedRun reference;
  std::vector<ComparedRun> runs;
};

struct ComparisonSettings {
  std::filesystem::path scenario;
  std::filesystem::path folder;  ///< of results
  std::filesystem::path cache;   ///< empty for the default one
  bool keep_runs = false;        ///< a folder for each run
  int repeats = 0;               ///< 0: until they last kEnough together
};
/// Runs shorter than this are simulated again, until they last as long [s].
inline constexpr double kEnough = 0.2;

/// Simulates the reference and then every run of the plan.
/// @throws NumericalError if the reference stops; InputError for a choice that
/// its scene refuses.
[[nodiscard]] Comparison run_comparison(const ComparisonPlan& plan,
                                        const ComparisonSettings& settings);

/// Output times that steps of any compared length can reach: those of the
/// scenario, without what is nearer to the one before than `longest` [s]. The
/// last one stays.
[[nodiscard]] std::vector<double> thin_times(const std::vector<double>& times,
                                             double longest);

}  // namespace limber::app
