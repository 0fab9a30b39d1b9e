// SPDX-License-Identifier: BSD-3-Clause
#include "support/run_random_scene.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>

#include "limber/common/errors.hpp"

namespace limber::testing {
namespace {

bool is_finite(const dynamics::SystemState& state) {
  for (const dynamics::BodyState& body : state.bodies) {
    if (!body.p_WB.allFinite() || !body.quat_WB.coeffs().allFinite() ||
        !body.v_WB_W.allFinite() || !body.w_WB_B.allFinite()) {
      return false;
    }
  }
  return state.eta.allFinite() && state.etadot.allFinite();
}

}  // namespace

bool is_silent_about_drift(const RandomOutcome& outcome) {
  if (outcome.kind != RandomOutcome::Kind::finished) return false;
  const dynamics::EnergyRecord& energy = outcome.energy;
  if (!(outcome.drift > 0.0101 * energy.throughput) ||
      !(outcome.drift > 1.01 * energy.roundoff)) {
    return false;
  }
  const auto& warnings = outcome.statistics.warnings;
  return std::none_of(warnings.begin(), warnings.end(),
                      [](const std::string& text) {
                        return text.find("energy error") != std::string::npos;
                      });
}

RandomOutcome run_random_scene(unsigned seed,
                               const RandomSceneOptions& options) {
  using Kind = RandomOutcome::Kind;
  dynamics::SimulationStatistics statistics;
  dynamics::RunRecord record;
  bool all_finite = true;
  double drift = 0.0;
  std::optional<double> first;
  try {
    RandomScene scene = draw_scene(seed, options);
    dynamics::simulate(
        scene.model, scene.state, scene.settings,
        [&](const dynamics::SystemState& state,
            const dynamics::EnergyBalance& energy) {
          const double now = energy.total() + energy.dissipated - energy.work;
          if (!first) first = now;
          drift = std::max(drift, std::abs(now - *first));
          all_finite =
              all_finite && is_finite(state) && std::isfinite(energy.total());
        },
        {}, statistics, {}, {}, record);
    all_finite = all_finite && is_finite(scene.state);
  } catch (const InputError& error) {
    return {Kind::refused, error.what(), statistics};
  } catch (const NumericalError& error) {
    return {Kind::refused, error.what(), statistics};
  } catch (const std::exception& error) {
    return {Kind::failed, error.what(), statistics};
  }
  if (all_finite) return {Kind::finished, "", statistics, record.energy, drift};
  return {Kind::failed, "an output is not finite", statistics};
}

}  // namespace limber::testing
