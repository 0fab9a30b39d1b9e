// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

namespace limber::dynamics {

/// A run between two steps, as numbers: with the same model, initial state and
/// settings it goes on from there, to the bit.
struct Checkpoint {
  double time = 0.0;            ///< [s]
  std::vector<double> numbers;  ///< of an Archive
  /// What grows with the time: when kept, what came since the checkpoint
  /// before; to go on from, that of all checkpoints in a row.
  std::vector<double> log = {};
};

/// Who keeps checkpoints, and how often.
struct CheckpointKeeper {
  double interval = 60.0;  ///< of wall time, at least [s]
  /// Called between two steps, after all outputs up to then; empty: never.
  std::function<void(const Checkpoint&)> keep;
};

}  // namespace limber::dynamics
