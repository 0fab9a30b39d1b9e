// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/archive.hpp"
#include "dynamics/energy.hpp"

namespace limber::dynamics {

/// Tells a run that blows up, long before its numbers overflow.
///
/// Equation   stored energy > 10 (energy at the start + sum |work of a step|)
///            at two looks in a row, and growing or at the end of the run; or
///            > 1000 times at one.
///            (A scheme that takes its work from a step's start has none in its
///            first step from rest.)
/// Limits     An integrator that gains less is not stopped on the way: what it
///            left open is judged at the end (dynamics/energy_verdict).
class EnergyWatch {
 public:
  EnergyWatch() = default;
  /// @param initial energy at the start [J]
  explicit EnergyWatch(double initial) : supplied_(initial) {}

  /// After every step. @param work of loads, gravity and drives [J]
  void add(double work) { supplied_ += work < 0.0 ? -work : work; }
  /// @param stored energy now [J] @param is_end whether the run ends here
  /// @returns whether it can only be an artefact
  [[nodiscard]] bool is_blown_up(double stored, bool is_end = false) {
    const bool is_too_much = !(stored <= kFactor * supplied_ + kLeast);
    const bool is_far_off = supplied_ > 0.0 && stored > kFarFactor * supplied_;
    const bool was_too_much = last_ < kNone;
    const bool is_blown = is_too_much && (is_far_off || !(stored <= last_) ||
                                          (is_end && was_too_much));
    last_ = is_too_much ? stored : kNone;
    return is_blown;
  }
  [[nodiscard]] double supplied() const { return supplied_; }  ///< [J]

  void exchange_memory(Archive& archive) { archive(supplied_, last_); }

 private:
  static constexpr double kFactor = 10.0;
  static constexpr double kFarFactor = 1000.0;
  static constexpr double kLeast = 1e-9;  // of a system at rest [J]
  static constexpr double kNone = 1e300;
  double supplied_ = 0.0;
  double last_ = kNone;
};

}  // namespace limber::dynamics
