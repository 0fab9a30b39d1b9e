// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/dynamics/system/system_state.hpp"
#include "limber/dynamics/terms/system_terms.hpp"

namespace limber::dynamics {

/// Advances the Maxwell elements of all bodies over a step, for any motion of
/// the modes (MaxwellStep). Nothing is allocated in a step.
class MaxwellMotion {
 public:
  using Rule = void (*)(const flexbody::MaxwellElements&, double,
                        flexbody::MaxwellStep&);

  /// @param rule flexbody::set_linear_step or set_middle_step
  MaxwellMotion(const SystemModel& model, Rule rule);

  /// For steps of h [s]; gives the elements' stiffness over them to Newton's
  /// method.
  void set_step(double h, SystemTerms& terms);
  /// Sets to.maxwell, for the modes of both states.
  void advance(const SystemState& from, SystemState& to) const;
  [[nodiscard]] const flexbody::MaxwellStep& step_of(std::size_t body) const {
    return steps_[body];
  }

 private:
  const SystemModel& model_;
  Rule rule_;
  double h_ = -1.0;  // of the steps below, -1: none [s]
  std::vector<flexbody::MaxwellStep> steps_;  // one a body
};

}  // namespace limber::dynamics
