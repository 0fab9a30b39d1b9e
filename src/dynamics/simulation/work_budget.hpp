// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace limber::dynamics {

/// How much work a run may take beyond what its steps promise, counted, so that
/// a run ends alike on every machine.
///
/// Equation   shares of halved steps <= 1000 + 10 steps,
///            linear solves <= 2e6 / bodies + 300 steps
/// Source     own choice. A step takes 2 to 3 solves as a rule, one with exact
///            corrections 30 to 300; a body's share of a solve takes about
///            4 us with its share of the rest, so that what a short run may
///            take for nothing is some 10 s, of any number of bodies.
class WorkBudget {
 public:
  explicit WorkBudget(std::size_t bodies)
      : free_solves_(kFreeBodySolves / static_cast<long>(bodies + 1)) {}

  [[nodiscard]] bool allows_shares(long shares, long steps) const {
    return shares <= kFreeShares + kSharesAStep * steps;
  }
  [[nodiscard]] bool allows_solves(long solves, long steps) const {
    return solves <= free_solves_ + kSolvesAStep * steps;
  }

 private:
  static constexpr long kFreeShares = 1000;
  static constexpr long kSharesAStep = 10;
  static constexpr long kFreeBodySolves = 2'000'000;
  static constexpr long kSolvesAStep = 300;
  long free_solves_;
};

}  // namespace limber::dynamics
