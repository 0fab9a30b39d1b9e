// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/joints/coordinates/scalar_motion.hpp"

/// Motion and response of couplers at a state, for observers. Commands that
/// jump at its time are evaluated after the jump.
namespace limber::dynamics {

/// A coupler's motion and the response of its own law, without tendons and
/// gears that act on a joint.
struct CouplerReading {
  Matrix3 R_WF = Matrix3::Identity();  ///< [-]
  joints::RelativeMotion motion;
  joints::CouplerResponse response;
};
/// @throws NumericalError as its law does.
[[nodiscard]] CouplerReading evaluate_coupler(const SystemModel& model,
                                              const SystemState& state,
                                              CouplerIndex coupler);

using joints::CoordinateReading;

/// A coordinate of its law, with the whole turns stored in the state's memory.
/// @param coordinate from 0
/// @throws ContractError for one that does not exist.
/// @throws NumericalError where the coordinate is undefined.
[[nodiscard]] CoordinateReading evaluate_coordinate(const SystemModel& model,
                                                    const SystemState& state,
                                                    CouplerIndex coupler,
                                                    int coordinate);

/// @throws NumericalError if two points of a path coincide.
[[nodiscard]] CoordinateReading evaluate_transmission(
    const SystemModel& model, const SystemState& state,
    TransmissionIndex transmission);

}  // namespace limber::dynamics
