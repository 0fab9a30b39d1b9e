// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

/// Errors of a run's probes by cause: docs/reference/errors.md.
namespace limber::runs {

/// Values of one column, at the outputs and of the peak over all steps.
struct ColumnValues {
  std::vector<double> curve;  ///< [unit of the column]
  double peak = 0.0;
};

/// A run that shows a cause. Its columns are those of the run itself.
struct ErrorRun {
  std::string name;
  std::string finer;
  double factor = 1.0;                ///< of its differences [-]
  double seconds = 0.0;               ///< wall time of its steps [s]
  std::string failure;                ///< why there are no columns; else empty
  std::vector<ColumnValues> columns;  ///< in the order of the run's
};

[[nodiscard]] inline bool is_known(const ErrorRun& run) {
  return run.failure.empty();
}

struct ColumnError {
  double peak = 0.0;   ///< of the largest magnitude [unit of the column]
  double curve = 0.0;  ///< largest of all outputs
};

struct ProbeErrors {
  std::string column;
  std::string unit;
  double peak = 0.0;                  ///< of the run
  std::vector<ColumnError> by_cause;  ///< in the order of the runs
  ColumnError total;  ///< sum of the causes, or what all together show
  /// False where all causes together show more than twice their sum, as where
  /// bounces are chaotic; none where there is no such run.
  std::optional<bool> adds_up;
  /// Index of the cheapest run whose cause alone has half of the total.
  std::optional<std::size_t> remedy;
  /// Peak and total are below 1e-9 of the largest peak of the probe's columns
  /// in this unit.
  bool is_noise = false;
};

struct ErrorTable {
  std::vector<ErrorRun> runs;  ///< without their columns
  std::vector<ProbeErrors> probes;
  std::vector<std::string> unknown;  ///< what has no run, and why
};

/// @param own columns of the run; @param together the run with all causes at
/// once, if it was completed
/// @pre as many outputs in all curves
[[nodiscard]] ErrorTable compare_causes(
    const std::vector<std::string>& names,
    const std::vector<std::string>& units, const std::vector<ColumnValues>& own,
    std::vector<ErrorRun> runs, const std::optional<ErrorRun>& together);

}  // namespace limber::runs
