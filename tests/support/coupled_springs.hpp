// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "limber/joints/pairs/pair_interaction.hpp"

namespace limber::testing {

/// Three lines between made-up places, each of which pulls by the stretch of
/// all.
///
/// Equation   force_i = -sum_j K_ij (p_B - p_A)_j, K any 9 x 9 matrix
class CoupledSprings final : public joints::PairInteraction {
 public:
  CoupledSprings(int modes_A, int modes_B, unsigned seed);

  [[nodiscard]] std::string_view kind() const override { return "coupled"; }
  void describe_parameters(Manifest& /*out*/) const override {}
  [[nodiscard]] std::size_t most_points() const override { return kPoints; }
  [[nodiscard]] bool couples_points() const override { return true; }
  void check(int /*modes_A*/, int /*modes_B*/) const override {}
  void evaluate(const joints::PairBodies& bodies, const EvaluationTime& now,
                std::span<const double> memory,
                joints::PairResponse& out) const override;

 private:
  static constexpr std::size_t kPoints = 3;

  std::vector<joints::PairPlace> places_;  // on A and on B, in turn
  MatrixX stiffness_;                      // K [N/m]
};

}  // namespace limber::testing
