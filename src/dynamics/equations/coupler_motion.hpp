// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/system_model.hpp"
#include "dynamics/system_state.hpp"
#include "joints/scalar_motion.hpp"

/// What couplers see and answer at a state, for those who look on. A time at
/// which a command jumps counts as after the jump.
namespace limber::dynamics {

/// A coupler's motion and the answer of its own law: what tendons and gears do
/// to a joint is not in it.
struct CouplerReading {
  Matrix3 R_WF = Matrix3::Identity();
  joints::RelativeMotion motion;
  joints::CouplerResponse response;
};
/// @throws NumericalError as its law does.
[[nodiscard]] CouplerReading evaluate_coupler(const SystemModel& model,
                                              const SystemState& state,
                                              CouplerIndex coupler);

/// A coordinate, with the whole turns of the state's memory, and the sum of
/// what acts along it.
struct CoordinateReading {
  joints::ScalarMotion motion;
  joints::ScalarResponse response;
};
/// @param coordinate of a joint, from 0
/// @throws NumericalError where the coordinate has no meaning.
[[nodiscard]] CoordinateReading evaluate_coordinate(const SystemModel& model,
                                                    const SystemState& state,
                                                    CouplerIndex coupler,
                                                    int coordinate);

/// @throws NumericalError where two points of a path meet.
[[nodiscard]] CoordinateReading evaluate_transmission(
    const SystemModel& model, const SystemState& state,
    TransmissionIndex transmission);

}  // namespace limber::dynamics
