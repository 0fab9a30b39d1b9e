// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace limber::dynamics {

/// A simulation between two steps, as numbers. With the same model, initial
/// state and settings it continues from there identically to the bit.
struct Checkpoint {
  double time = 0.0;            ///< [s]
  std::vector<double> numbers;  ///< of an Archive [mixed units]
  /// Data that grow with time [mixed units]: when saved, those since the last
  /// checkpoint; to resume, those of all checkpoints, concatenated.
  std::vector<double> log = {};
};

/// Saves checkpoints at intervals.
struct CheckpointKeeper {
  double interval = 60.0;  ///< shortest, of wall time [s]
  /// Called between two steps, after all outputs until then; empty: no
  /// checkpoints.
  std::function<void(const Checkpoint&)> keep;
};

/// Checkpoints to save, and one to resume from.
struct Continuation {
  CheckpointKeeper keeper = {};
  /// Saved with the same model, initial state and settings.
  std::optional<Checkpoint> from = {};
};

}  // namespace limber::dynamics
