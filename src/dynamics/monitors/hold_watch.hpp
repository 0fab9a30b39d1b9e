// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/equations/workspace.hpp"
#include "limber/joints/coordinates/motion.hpp"

namespace limber::dynamics {

/// Monitors the displacement of joints in their constrained directions.
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
  /// One for each joint displaced by more than kLargest.
  [[nodiscard]] std::vector<std::string> find_warnings() const;
  /// Of a body's size, and in rotation [-, rad].
  static constexpr double kLargest = 1e-3;

  /// The joint that was displaced most, if by more than kOverpowered; nothing
  /// if none was.
  [[nodiscard]] std::optional<std::string> find_overpowered() const;
  /// Of a body's size, and in rotation: larger than any displacement of a joint
  /// whose springs hold [-, rad].
  static constexpr double kOverpowered = 0.5;

  /// Saves or restores its state for checkpoints.
  void exchange_memory(Archive& archive);

 private:
  struct Hold {
    std::size_t coupler = 0;
    std::size_t body = 0;  // the smaller of those joined
    double size = 0.0;     // [m]
    joints::HoldStiffness stiffness;
    double give = 0.0;       // d at its largest [m]
    double turn = 0.0;       // theta at its largest [rad]
    double give_time = 0.0;  // [s]
    double turn_time = 0.0;  // [s]
    // The larger of both, relative to the body's size or in [rad].
    [[nodiscard]] double largest() const { return std::max(give / size, turn); }
  };
  [[nodiscard]] std::string describe(const Hold& hold) const;

  const SystemModel& model_;
  std::vector<Hold> holds_;
};

}  // namespace limber::dynamics
