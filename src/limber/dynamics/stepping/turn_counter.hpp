// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limber/dynamics/terms/system_terms.hpp"

namespace limber::dynamics {

/// Counts the full turns of joints from step to step (CouplerMemory::near).
///
/// Limits     a step rotates a joint by less than half a turn more or less than
///            its rate at the step's end times the step
class TurnCounter {
 public:
  /// @param by_rate whether a step's rotation follows its rate beyond half a
  /// turn; that of energy_conserving, a Cayley transform, stays below
  TurnCounter(const SystemModel& model, bool by_rate);

  /// Whether a step of h [s] may rotate a joint by more than half a turn.
  [[nodiscard]] bool may_turn_far(const SystemState& state, double h) const;

  /// Stores the angles at the end of a step, whose forces were those of angles
  /// nearest to the ones at its begin.
  /// @param terms at `state`, approximately  @param h of the step [s]
  /// @returns why these forces were wrong, if they were; then nothing is stored
  [[nodiscard]] std::optional<std::string> count(const SystemTerms& terms,
                                                 double h,
                                                 SystemState& state) const;

 private:
  struct Angle {
    CouplerIndex coupler;
    std::size_t coordinate;
    bool is_in_transmission;
  };
  [[nodiscard]] bool depends_on_turns(const Angle& angle, double near,
                                      const SystemTerms& terms,
                                      const SystemState& state) const;

  const SystemModel& model_;
  bool by_rate_;
  std::vector<Angle> angles_;
};

}  // namespace limber::dynamics
