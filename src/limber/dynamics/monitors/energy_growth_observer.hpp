// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "limber/common/records/archive.hpp"

namespace limber::dynamics {

/// Detects a group of bodies that blows up, long before it overflows.
///
/// Equation   stored energy > 10 (energy at the start + sum |work of a step|)
///            at two successive checks, and growing or at the end of the run;
///            or > 1000 times at one check, unless work lags: a scheme that
///            evaluates it at a step's start has none in the first step from
///            rest, at the start or at the onset of a load. The energy before
///            is then round-off, and the work of any load much larger.
/// Limits     smaller gains of energy do not stop a run; they are judged at its
///            end (dynamics/monitors/energy_verdict.hpp).
class EnergyGrowthObserver {
 public:
  EnergyGrowthObserver() = default;
  /// @param initial energy at the start [J]
  /// @param lags whether a step's work uses the velocities at its start
  EnergyGrowthObserver(double initial, bool lags)
      : supplied_(initial), lags_(lags) {}

  /// Adds a step, or energy that bodies have beside each other that meet.
  /// @param work of loads, gravity and drives [J]
  void add(double work) { supplied_ += work < 0.0 ? -work : work; }
  /// @param stored current energy [J]
  /// @param is_end whether the run ends here
  /// @param noise energy that may be round-off [J]
  /// @returns whether it can only be a numerical artefact
  [[nodiscard]] bool is_blown_up(double stored, bool is_end = false,
                                 double noise = 0.0) {
    const bool was_too_much = was_too_much_;
    was_too_much_ = is_too_much(stored, noise);
    const bool is_far_off =
        !lags_ && supplied_ > 0.0 && stored > kFarFactor * supplied_ + noise;
    const bool stays = was_too_much && (is_end || !(stored <= last_));
    last_ = stored;
    return was_too_much_ && (is_far_off || stays || !std::isfinite(stored));
  }
  /// Whether more than ten times the energy at the start and of the work is
  /// stored.
  [[nodiscard]] bool is_too_much(double stored, double noise = 0.0) const {
    return !(stored <= kFactor * supplied_ + noise);
  }
  [[nodiscard]] double supplied() const { return supplied_; }  ///< [J]

  void exchange_memory(Archive& archive) {
    archive(supplied_, lags_, was_too_much_, last_);
  }

 private:
  static constexpr double kFactor = 10.0;       // [-]
  static constexpr double kFarFactor = 1000.0;  // [-]
  double supplied_ = 0.0;
  bool lags_ = false;
  bool was_too_much_ = false;  // at the last check
  double last_ = 0.0;          // energy then [J]
};

}  // namespace limber::dynamics
