// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/newton/newton_matrix.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Shortens steps while a joint strikes an end stop, so that its restitution is
/// that of the stop, whatever the step of a run.
///
/// Equation   omega h <= pi / n, n steps a half period, and
///            omega^2 = k (1 + b v) Y, k and b of the stop, v the rate at which
///            it is reached and Y the mobility of the joint's coordinate there,
///            w^2 f' (w^2 M + w D + K)^-1 f at w = omega, f the forces of a
///            unit force along it: what is much stiffer holds as a constraint.
///            A stop against which the joint accelerates by a, so that it would
///            be away for less than half a step, 2 v / a < h / 2, or by less
///            than a hundredth of the tolerance, v^2 / (2 a), is at rest and
///            does not count; nor does one that was reached longer than six
///            half periods ago.
/// Limits     stops of joints, in systems without unreduced bodies
class StopSteps {
 public:
  /// @param model stored by reference
  /// @param steps n > 0 [-]
  /// @param tolerance of the run, 0 with fixed steps [m]
  StopSteps(const SystemModel& model, double steps, double tolerance);

  /// Length of the next step from a state, at most h [s].
  [[nodiscard]] double limit(double h, const SystemState& state);

  /// Saves or restores its state for checkpoints.
  void exchange_memory(Archive& archive);

 private:
  // One end of a stop.
  struct End {
    std::size_t coupler = 0;
    std::size_t coordinate = 0;
    std::size_t place = 0;   // of its switch in the coupler's memory
    double stiffness = 0.0;  // k [N/m or N m/rad]
    double damping = 0.0;    // b [s/m or s/rad]
    double outwards = 1.0;   // sign of z beyond it [-]
    bool is_on = false;      // the joint is at it
    bool counts = false;     // and strikes it
    double frequency = 0.0;  // omega [rad/s]
    double reached = 0.0;    // when it was, the last time [s]
  };

  void update(End& end, double h, const SystemState& state);
  // A strike at a state: whether it counts, and its frequency.
  void begin(End& end, double h, const SystemState& state);

  const SystemModel& model_;
  double steps_;
  double tolerance_;
  std::vector<End> ends_;
  double longest_ = std::numeric_limits<double>::infinity();  // next step [s]
  // Of begin().
  SystemState apart_;
  SystemState moving_;
  SystemTerms terms_;
  NewtonMatrix matrix_;
  VectorX no_motion_;
  std::vector<Vector6> no_gaps_;
  VectorX residual_;
  VectorX increments_;
};

}  // namespace limber::dynamics
