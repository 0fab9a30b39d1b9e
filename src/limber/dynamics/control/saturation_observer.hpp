// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// The followers of an input: "joint 'elbow'", several separated by commas; "no
/// follower".
[[nodiscard]] std::string name_followers(const SystemModel& model, int input);

/// Finds controllers whose output oscillates as that of an unstable sampled
/// loop: between its limits, in 20 samples at one of them with at least 8
/// changes to the other; or from each of 20 samples to the next, growing at
/// each and tenfold in all, to a hundredth of the range. Changes of the limit
/// that are further apart than 10 (1 + delay + tau / T) samples do not count:
/// so slow a motion is not of the samples, which lag by 1 + delay periods T and
/// the filter's tau.
///
/// Limits     of controllers with finite limits (PidController). A steady or
///            slow oscillation within the limits is not found
class SaturationObserver {
 public:
  /// @param model stored by reference
  explicit SaturationObserver(const SystemModel& model);

  /// After samples at `state`. Adds a warning, once per controller, with a
  /// period to try, and shorter steps where a period has fewer than 8: too few
  /// steps can make a stable loop unstable.
  /// @param step the last one [s]
  void include(const SystemState& state, double step,
               std::vector<std::string>& warnings);

  /// Saves or restores its state for checkpoints.
  void exchange_memory(Archive& archive);

 private:
  struct Output {
    std::size_t controller = 0;
    double lower = 0.0;
    double upper = 0.0;
    long longest = 0;         // of samples between changes that count
    long seen = 0;            // samples taken
    int side = 0;             // the last limit, -1: lower, 1: upper; 0: none
    long changed = 0;         // sample of the last change to the other limit
    long first = 0;           // sample of the first change that counts
    long count = 0;           // samples at a limit since then
    long changes = 0;         // likewise
    double value = 0.0;       // of the last sample
    double jump = 0.0;        // to it from the one before
    double first_jump = 0.0;  // of those that alternate and grow
    long jumps = 0;           // their number
    bool was_reported = false;
  };
  static void count_sample(double value, Output& output);
  static void count_jump(double value, Output& output);
  // What the output does; empty: nothing unusual.
  [[nodiscard]] std::string find_oscillation(const Output& output,
                                             double step) const;

  const SystemModel& model_;
  std::vector<Output> outputs_;
};

}  // namespace limber::dynamics
