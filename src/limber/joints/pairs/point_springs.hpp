// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/joints/pairs/pair_interaction.hpp"
#include "limber/joints/point_spring.hpp"

namespace limber::joints {

/// Any number of springs and dampers between points of two bodies, such as the
/// lines of a net or the blocks of a mount, in place of a coupler each.
///
/// Equation   each as PointSpring; over a step as it, so that energies balance
/// Limits     a line that only pulls is slack or taut depending on its length,
///            without an event where it changes.
class PointSprings final : public PairInteraction {
 public:
  struct Line {
    PairPlace on_A;
    PairPlace on_B;
    PointSpring spring;
  };

  /// @throws InputError if there is no line, or a place is not finite.
  explicit PointSprings(std::vector<Line> lines);

  [[nodiscard]] std::string_view kind() const override {
    return "point springs";
  }
  void describe_parameters(Manifest& out) const override;
  [[nodiscard]] std::size_t most_points() const override {
    return lines_.size();
  }
  void check(int modes_A, int modes_B) const override;
  /// A line without force and stiffness is no point.
  /// @throws NumericalError as PointSpring::evaluate.
  void evaluate(const PairBodies& bodies, const EvaluationTime& now,
                std::span<const double> memory,
                PairResponse& out) const override;
  void evaluate_over_step(const PairStep& step, std::span<const double> memory,
                          PairResponse& out) const override;

 private:
  std::vector<Line> lines_;
};

constexpr auto fields_of(const PairPlace*) {
  return list_fields("place", "undeformed [m]", "Phi_B");
}

constexpr auto fields_of(const PointSprings::Line*) {
  return list_fields("line", "on A", "on B", "spring");
}

}  // namespace limber::joints
