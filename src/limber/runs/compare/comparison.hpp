// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "limber/common/progress.hpp"
#include "limber/results/motion_error.hpp"
#include "limber/runs/compare/comparison_plan.hpp"
#include "limber/runs/compare/pair_contact.hpp"
#include "limber/runs/run.hpp"

/// Runs of a scene at several levels, bases and steps beside a reference, as
/// `limber compare` does: docs/reference/compare.md.
namespace limber::runs {

/// Difference of one probe column from the reference, over all output times.
struct ProbeDifference {
  double rms = 0.0;  ///< [as `unit`]
  double max = 0.0;  ///< [as `unit`]
  std::string unit;
};

/// Cost of a run.
struct Cost {
  double online = 0.0;  ///< wall time per simulated time, minimum of the
                        ///< repeats [-]
  int repeats = 0;      ///< count of the runs of which it is the minimum
  /// Wall time of the reductions [s]; none if one came from the cache.
  std::optional<double> offline;
  long steps = 0;              ///< count
  long newton_iterations = 0;  ///< count
  int modes = 0;               ///< number of modes
};

/// One run of a comparison, without its states.
struct ComparedRun {
  Choice choice;
  Cost cost;
  std::optional<results::SystemMotionError> error;  ///< if it was completed
  std::optional<double> energy_drift;  ///< largest, of the throughput [-]
  std::map<std::string, ProbeDifference> probes;
  std::vector<PairContact> contacts;  ///< until it ended
  std::string stopped;                ///< why and when it ended early, or empty
  results::History history;           ///< probes only
};

struct Comparison {
  std::filesystem::path scenario;
  std::string reference_note;  ///< describe_default_reference
  ComparedRun reference;
  std::vector<ComparedRun> runs;
};

struct ComparisonSettings {
  std::filesystem::path scenario;
  std::vector<scene::Setting> settings;  ///< applied to it in every run
  /// Reductions that report to the given progress; none needed for rigid
  /// scenes.
  std::function<Reductions(const Progress&)> make_reductions{};
  bool judges_levels = false;  ///< whether to find Run::levels; costs time
  int repeats = 0;             ///< count; 0: until they take kEnough together
  /// Shown progress: of all simulations together, else of one run's work.
  Progress progress{};
  /// Called during all work; may throw to end the current run
  /// (dynamics::Interrupted).
  Progress watch{};
  /// Called with the notes and warnings of runs, each text once.
  std::function<void(const scene::Scene&, const std::string&)> note{};
  std::function<void(const std::string&)> warn{};
  /// Called with each run while it has its states.
  std::function<void(const Choice&, const Run&)> keep{};
};
/// Runs shorter than this are repeated until they take this long together [s].
inline constexpr double kEnough = 0.2;

/// Simulates the reference and then every run of the plan (make_plan).
/// @throws NumericalError if the reference fails; InputError for a choice that
/// the scene rejects.
[[nodiscard]] Comparison compare_runs(const ComparisonPlan& plan,
                                      const ComparisonSettings& settings);

/// Output times that all compared steps can reach: those of the scenario,
/// without those nearer than `longest` [s] to the previous one. The last one is
/// always included.
[[nodiscard]] std::vector<double> thin_times(const std::vector<double>& times,
                                             double longest);

}  // namespace limber::runs
