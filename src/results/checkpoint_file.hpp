// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/append_file.hpp"
#include "common/manifest.hpp"
#include "dynamics/checkpoint.hpp"
#include "results/history.hpp"

namespace limber::results {

/// A run that is under way, with what it has left behind so far.
struct CheckpointRecord {
  Manifest manifest;  ///< what the run is made of
  dynamics::Checkpoint run;
  History history;
  std::filesystem::path log;  ///< where the history is
  FilePart part;              ///< of it
};

/// Leaves checkpoints of one run: a file of the state between two steps, which
/// is written as a whole, and beside it a log that what was left behind since
/// is appended to. The file says how far the log is its own, so that a run
/// that is killed at any moment leaves a checkpoint, or that before it.
class CheckpointWriter {
 public:
  /// Of a run that begins. Nothing is written yet.
  CheckpointWriter(std::filesystem::path file, Manifest manifest);
  /// Of a run that goes on from `record`.
  /// @throws InputError if its log cannot be written.
  CheckpointWriter(std::filesystem::path file, const CheckpointRecord& record);

  /// @throws InputError if the place cannot be written. The next attempt makes
  /// up for it.
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

/// Whether it says that it is one, whole or damaged.
[[nodiscard]] bool is_checkpoint_file(const std::filesystem::path& file);

/// @throws InputError if the file is no checkpoint, is damaged or is of another
/// version of the layout: every byte of it and its log counts.
[[nodiscard]] CheckpointRecord read_checkpoint(
    const std::filesystem::path& file);

}  // namespace limber::results
