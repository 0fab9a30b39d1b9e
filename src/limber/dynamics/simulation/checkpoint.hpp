// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "limber/common/records/archive.hpp"

namespace limber::dynamics {

/// A simulation between two steps, or before the first, as numbers. With the
/// same model, initial state and settings it continues from there identically
/// to the bit.
struct Checkpoint {
  double time = 0.0;  ///< [s]
  /// Of an Archive; of a run before its first step only those of outer loops
  /// (CheckpointKeeper::exchange_outer) [mixed units].
  std::vector<double> numbers = {};
  /// Data that grow with time [mixed units]: when saved, those since the last
  /// checkpoint; to resume, those of all checkpoints, concatenated.
  std::vector<double> log = {};
  /// Number of outputs that were observed before it, since the start of the
  /// run; a resumed run observes those after them.
  std::size_t outputs = 0;
};

/// Saves checkpoints at intervals, and the last one of a run that is
/// interrupted. They are those of a refresh (TimeLoop), which may be steps
/// before the present; the start is the first.
struct CheckpointKeeper {
  double interval = 60.0;  ///< shortest, of wall time [s]
  /// Called between two steps; empty: no checkpoints. An interrupted run that
  /// has made no new one since its start or the last call does not call it.
  std::function<void(const Checkpoint&)> keep;
  /// Saves or restores data of outer loops, before those of the run; may be
  /// empty.
  std::function<void(Archive&)> exchange_outer = {};
};

/// Checkpoints to save, and one to resume from.
struct Continuation {
  CheckpointKeeper keeper = {};
  /// Saved with the same model, initial state and settings.
  std::optional<Checkpoint> from = {};
};

}  // namespace limber::dynamics
