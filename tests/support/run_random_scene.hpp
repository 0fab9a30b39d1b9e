// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/errors.hpp"
#include "support/random_scene.hpp"

namespace limber::testing {

/// How a random scene ended.
struct RandomOutcome {
  enum class Kind {
    finished,  ///< with numbers at every output
    refused,   ///< by an InputError or a NumericalError with words
    failed,    ///< no number called a success, or any other exception
  };
  Kind kind = Kind::finished;
  std::string text;  ///< why, unless it finished
  long steps = 0;
};

inline bool is_finite(const dynamics::SystemState& state) {
  for (const dynamics::BodyState& body : state.bodies) {
    if (!body.p_WB.allFinite() || !body.quat_WB.coeffs().allFinite() ||
        !body.v_WB_W.allFinite() || !body.w_WB_B.allFinite()) {
      return false;
    }
  }
  return state.eta.allFinite() && state.etadot.allFinite();
}

inline RandomOutcome run_random_scene(unsigned seed) {
  using Kind = RandomOutcome::Kind;
  dynamics::SimulationStatistics statistics;
  bool all_finite = true;
  try {
    RandomScene scene = draw_scene(seed);
    dynamics::simulate(
        scene.model, scene.state, scene.settings,
        [&](const dynamics::SystemState& state,
            const dynamics::EnergyBalance& energy) {
          all_finite =
              all_finite && is_finite(state) && std::isfinite(energy.total());
        },
        {}, statistics);
    all_finite = all_finite && is_finite(scene.state);
  } catch (const InputError& error) {
    return {Kind::refused, error.what(), statistics.steps};
  } catch (const NumericalError& error) {
    return {Kind::refused, error.what(), statistics.steps};
  } catch (const std::exception& error) {
    return {Kind::failed, error.what(), statistics.steps};
  }
  if (all_finite) return {Kind::finished, "", statistics.steps};
  return {Kind::failed, "an output is not finite", statistics.steps};
}

}  // namespace limber::testing
