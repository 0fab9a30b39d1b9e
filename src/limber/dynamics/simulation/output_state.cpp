// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/output_state.hpp"

#include "limber/common/index.hpp"
#include "limber/dynamics/system/interpolation.hpp"
#include "limber/dynamics/terms/kinematics.hpp"

namespace limber::dynamics {
namespace {

Vector6 find_wrench(const SystemModel& model, const SystemState& state,
                    CouplerIndex c) {
  return joints::evaluate(model.couplers[index(c)].law,
                          find_relative_motion(model, state, c),
                          state.memory[index(c)], now_of(state))
      .wrench;
}

}  // namespace

void find_output_state(const SystemModel& model, const SystemState& begin,
                       const SystemState& end, double fraction,
                       SystemState& state) {
  interpolate(model, begin, end, fraction, state);
  for (CouplerIndex c(0); c < std::ssize(model.couplers); ++c) {
    const joints::CouplerLaw& law = model.couplers[index(c)].law;
    if (!std::holds_alternative<joints::Joint>(law) || joints::is_ideal(law)) {
      continue;
    }
    const Vector6 first = find_wrench(model, begin, c);
    const Vector6 last = find_wrench(model, end, c);
    const Vector6 between = first + fraction * (last - first);
    // The joint takes of it what is in its constrained directions.
    state.memory[index(c)].constraint_wrench =
        between - find_wrench(model, state, c);
  }
}

}  // namespace limber::dynamics
