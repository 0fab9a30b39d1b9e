// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace limber::dynamics {

/// Limits of a run's work by counts, so that it ends equally on every machine.
///
/// Equation   parts of halved steps <= 1000 + 10 steps,
///            linear solves <= 2e6 / bodies + 300 steps
/// Source     own choice. A step usually takes 2 to 3 solves, with exact
///            corrections 30 to 300; a solve with its other work takes about
///            4 us per body, so that a failing short run ends within about
///            10 s for any number of bodies.
class WorkBudget {
 public:
  explicit WorkBudget(std::size_t bodies)
      : free_solves_(kFreeBodySolves / static_cast<long>(bodies + 1)) {}

  [[nodiscard]] bool allows_fractions(long fractions, long steps) const {
    return fractions <= kFreeFractions + kSharesAStep * steps;
  }
  [[nodiscard]] bool allows_solves(long solves, long steps) const {
    return solves <= free_solves_ + kSolvesAStep * steps;
  }

 private:
  static constexpr long kFreeFractions = 1000;
  static constexpr long kSharesAStep = 10;
  static constexpr long kFreeBodySolves = 2'000'000;
  static constexpr long kSolvesAStep = 300;
  long free_solves_;
};

}  // namespace limber::dynamics
