// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/coupler_motion.hpp"

#include "limber/common/index.hpp"
#include "limber/dynamics/equations/transmission.hpp"
#include "limber/dynamics/terms/kinematics.hpp"

namespace limber::dynamics {

CouplerReading evaluate_coupler(const SystemModel& model,
                                const SystemState& state,
                                CouplerIndex coupler) {
  const Coupler& c = model.couplers.at(index(coupler));
  const FrameMotion F = find_frame_motion(model, state, c.frame_F);
  CouplerReading reading;
  reading.R_WF = F.X_WF.R;
  reading.motion = relate(F, find_frame_motion(model, state, c.frame_M));
  reading.response = joints::evaluate(
      c.law, reading.motion, state.memory[index(coupler)], now_of(state));
  return reading;
}

CoordinateReading evaluate_coordinate(const SystemModel& model,
                                      const SystemState& state,
                                      CouplerIndex coupler, int coordinate) {
  return joints::read(model.couplers.at(index(coupler)).law, coordinate,
                      find_relative_motion(model, state, coupler),
                      state.memory[index(coupler)], now_of(state));
}

CoordinateReading evaluate_transmission(const SystemModel& model,
                                        const SystemState& state,
                                        TransmissionIndex transmission) {
  const Transmission& t = model.transmissions.at(index(transmission));
  const joints::CouplerMemory& memory =
      state.memory[model.couplers.size() + index(transmission)];
  const joints::ScalarMotion motion = find_motion(model, state, t);
  const joints::ScalarResponse response =
      evaluate_laws(t, motion, memory, now_of(state));
  const bool pulls = std::holds_alternative<PathCoordinate>(t.coordinate);
  return {motion, response, pulls ? -response.force : response.force};
}

}  // namespace limber::dynamics
