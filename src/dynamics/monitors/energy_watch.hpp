// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/equations/energy.hpp"

namespace limber::dynamics {

/// Detects a run that blows up, long before it overflows.
///
/// Equation   stored energy > 10 (energy at the start + sum |work of a step|)
///            at two successive checks, and growing or at the end of the run;
///            or > 1000 times at one check, unless work lags: a scheme that
///            evaluates it at a step's start has none in the first step from
///            rest, at the start or at the onset of a load. The energy before
///            is then round-off, and the work of any load much larger.
/// Limits     smaller gains of energy do not stop a run; they are judged at its
///            end (dynamics/monitors/energy_verdict.hpp).
class EnergyWatch {
 public:
  EnergyWatch() = default;
  /// @param initial energy at the start [J]
  /// @param lags whether a step's work uses the velocities at its start
  EnergyWatch(double initial, bool lags) : supplied_(initial), lags_(lags) {}

  /// Adds a step.
  /// @param work of loads, gravity and drives [J]
  void add(double work) { supplied_ += work < 0.0 ? -work : work; }
  /// @param stored current energy [J]
  /// @param is_end whether the run ends here
  /// @returns whether it can only be a numerical artefact
  [[nodiscard]] bool is_blown_up(double stored, bool is_end = false) {
    const bool is_much = is_too_much(stored);
    const bool is_far_off =
        !lags_ && supplied_ > 0.0 && stored > kFarFactor * supplied_;
    const bool was_too_much = last_ < kNone;
    const bool is_blown = is_much && (is_far_off || !(stored <= last_) ||
                                      (is_end && was_too_much));
    last_ = is_much ? stored : kNone;
    return is_blown;
  }
  /// Whether more than ten times the energy at the start and of the work is
  /// stored.
  [[nodiscard]] bool is_too_much(double stored) const {
    return !(stored <= kFactor * supplied_ + kLeast);
  }
  /// Whether the last check found too much energy, but the lag of work may
  /// explain it until the next step.
  [[nodiscard]] bool has_doubt() const { return lags_ && last_ < kNone; }
  [[nodiscard]] double supplied() const { return supplied_; }  ///< [J]

  void exchange_memory(Archive& archive) { archive(supplied_, lags_, last_); }

 private:
  static constexpr double kFactor = 10.0;       // [-]
  static constexpr double kFarFactor = 1000.0;  // [-]
  static constexpr double kLeast = 1e-9;        // of a system at rest [J]
  static constexpr double kNone = 1e300;        // [J]
  double supplied_ = 0.0;
  bool lags_ = false;
  double last_ = kNone;
};

}  // namespace limber::dynamics
