// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/coupler_motion.hpp"

#include "common/errors.hpp"
#include "dynamics/kinematics.hpp"
#include "dynamics/transmission.hpp"

namespace limber::dynamics {
namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

Instant now_of(const SystemState& state) { return {state.t, Side::right}; }

}  // namespace

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
  const auto& joint =
      std::get<joints::Joint>(model.couplers.at(index(coupler)).law);
  LIMBER_EXPECT(coordinate >= 0 &&
                coordinate < std::ssize(joint.coordinates()));
  const joints::CouplerMemory& memory = state.memory[index(coupler)];
  const joints::CoordinateValue value =
      joints::evaluate(joint.coordinates()[index(coordinate)],
                       find_relative_motion(model, state, coupler),
                       memory.near[index(coordinate)]);
  CoordinateReading reading{{value.z, value.rate}, {}};
  std::size_t first = 0;  // of an element's switches
  for (const joints::JointElement& element : joint.elements()) {
    if (element.coordinate == coordinate) {
      reading.response += joints::evaluate(
          element.law, reading.motion, now_of(state),
          {memory.switches[first], memory.switches[first + 1]});
    }
    first += index(joints::switch_count(element.law));
  }
  return reading;
}

CoordinateReading evaluate_transmission(const SystemModel& model,
                                        const SystemState& state,
                                        TransmissionIndex transmission) {
  const Transmission& t = model.transmissions.at(index(transmission));
  const joints::CouplerMemory& memory =
      state.memory[model.couplers.size() + index(transmission)];
  const joints::ScalarMotion motion = find_motion(model, state, t);
  return {motion, evaluate_laws(t, motion, memory, now_of(state))};
}

}  // namespace limber::dynamics
