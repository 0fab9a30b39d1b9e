// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "limber/dynamics/monitors/energy_record.hpp"
#include "limber/dynamics/monitors/event.hpp"

namespace limber::app {

enum class RunEnd {
  finished,
  failed,   ///< by a NumericalError
  stopped,  ///< by a signal, with a summary
  killed,   ///< only its checkpoint is there
};

/// Record of a run, as stored in its results folder.
struct RunSummary {
  struct Steps {
    std::string by;  ///< name of a StepCause
    double count = 0.0;
    double time = 0.0;      ///< simulated [s]
    double shortest = 0.0;  ///< [s]
  };
  struct Level {
    std::string body;
    std::string used;
    std::string recommended;
    bool is_more_than_needed = false;
  };
  std::string folder;
  std::string scenario;  ///< its file; empty: not known
  RunEnd end = RunEnd::finished;
  std::string failure;    ///< message; empty: finished, or not known
  double reached = 0.0;   ///< last output [s]
  double end_time = 0.0;  ///< required; 0: not known [s]
  bool has_checkpoint = false;
  std::string integrator;
  double step = 0.0;       ///< longest [s]
  long step_changes = 0;   ///< count of those at given times
  double tolerance = 0.0;  ///< 0: fixed steps [m]
  long steps = 0;
  long iterations = 0;  ///< of Newton's method
  long halved = 0;
  long rejected = 0;
  double seconds_offline = 0.0;
  double seconds = 0.0;                 ///< wall time of the steps [s]
  std::map<std::string, double> parts;  ///< of it, by name [s]
  std::vector<Steps> limits;
  std::map<std::string, double> by_body;  ///< counts of steps by its error
  std::map<std::string, double> by_pair;  ///< counts of parts by its impacts
  std::vector<std::string> meshed;        ///< bodies that touch by a mesh
  std::vector<dynamics::Event> events;
  std::optional<double> unbalanced_fraction;  ///< largest energy error [-]
  std::string open_place;
  std::vector<dynamics::EnergyRow> rows;
  std::vector<Level> levels;
  bool has_errors = false;  ///< of its probes, by cause
  std::vector<std::string> warnings;
};

/// The name with the largest count; empty without any.
[[nodiscard]] std::string find_most(
    const std::map<std::string, double>& counts);

/// Reads the record of a run: summary.json, or the checkpoint of a run that was
/// killed.
/// @throws InputError if the folder has neither, stating its kind, or
/// if they are damaged or of another version.
[[nodiscard]] RunSummary read_run_summary(const std::filesystem::path& folder);

}  // namespace limber::app
