// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "limber/common/files/append_file.hpp"
#include "limber/common/records/manifest.hpp"
#include "limber/dynamics/simulation/checkpoint.hpp"
#include "limber/results/history.hpp"

namespace limber::results {

/// An unfinished run, with its results so far.
struct CheckpointRecord {
  Manifest manifest;  ///< all inputs of the run
  dynamics::Checkpoint run;
  History history;
  std::filesystem::path log;  ///< file with the history
  FilePart part;              ///< of it
};

/// Writes checkpoints of one run: a file with the state between two steps,
/// written atomically, and beside it a log to which new results are appended.
/// The file records the valid length of the log, so that a run that is killed
/// at any moment leaves this checkpoint or the previous one.
class CheckpointWriter {
 public:
  /// For a new run. Nothing is written yet.
  CheckpointWriter(std::filesystem::path file, Manifest manifest);
  /// For a run that continues from `record`.
  /// @throws InputError if its log cannot be written.
  CheckpointWriter(std::filesystem::path file, const CheckpointRecord& record);

  /// @param history at least the outputs before `run`; later ones are left out
  /// @throws InputError if it cannot be written. The next attempt includes the
  /// missing data.
  void write(const dynamics::Checkpoint& run, const History& history);

 private:
  void begin_log();

  std::filesystem::path file_;
  Manifest manifest_;
  std::filesystem::path log_file_;
  std::unique_ptr<AppendFile> log_;
  std::vector<double> pending_;    // of the runs' logs
  std::vector<std::size_t> ends_;  // of the history's lists in the log
};

/// Removes a checkpoint and its logs, if there are any.
void remove_checkpoint(const std::filesystem::path& file);

/// Whether the file has a checkpoint's header, even if damaged.
[[nodiscard]] bool is_checkpoint_file(const std::filesystem::path& file);

/// @throws InputError if the file is not a checkpoint, has another layout
/// version, or any byte of it or its log is damaged.
[[nodiscard]] CheckpointRecord read_checkpoint(
    const std::filesystem::path& file);

}  // namespace limber::results
