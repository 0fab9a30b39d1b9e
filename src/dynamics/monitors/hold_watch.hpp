// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "common/archive.hpp"
#include "dynamics/workspace.hpp"

namespace limber::dynamics {

/// Watches how far joints give way in directions that they hold.
///
/// Equation   d = |Kt p| / kt, theta = sqrt(2 V_r / kr), V_r the energy of the
///            rotation alone; both against the size l of the smaller of the
///            joined bodies: the larger of d / l and theta
/// Limits     a body's size is the distance to the farthest of its other
///            attachments, or its largest radius of gyration.
class HoldWatch {
 public:
  explicit HoldWatch(const SystemModel& model);

  /// @param terms of the end of a step at t [s]
  void include(const SystemTerms& terms, double t);
  /// One for each joint that gave way by more than kLargest.
  [[nodiscard]] std::vector<std::string> find_warnings() const;
  static constexpr double kLargest = 1e-3;  ///< of a body's size

  /// What it knows between steps.
  void exchange_memory(Archive& archive);

 private:
  struct Hold {
    std::size_t coupler = 0;
    std::size_t body = 0;            // the smaller of those joined
    double size = 0.0;               // [m]
    double stiffness = 0.0;          // kt [N/m]
    double turning_stiffness = 0.0;  // kr [N m/rad]
    double give = 0.0;               // d at its largest [m]
    double turn = 0.0;               // theta at its largest [rad]
    double give_time = 0.0;          // [s]
    double turn_time = 0.0;          // [s]
  };
  [[nodiscard]] std::string describe(const Hold& hold) const;

  const SystemModel& model_;
  std::vector<Hold> holds_;
};

}  // namespace limber::dynamics
