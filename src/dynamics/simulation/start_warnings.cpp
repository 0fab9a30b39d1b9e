// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/start_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/coupler_motion.hpp"
#include "limber/dynamics/simulation/breakpoints.hpp"
#include "limber/dynamics/system/oscillation.hpp"

namespace limber::dynamics {
namespace {

// Excess relative to the coordinate's size that counts as none [-].
constexpr double kOnStop = 1e-9;
// Fixed steps in a period: with 8 the mean force in a step errs by up to 5 % of
// the amplitude, with 16 by 1.3 %.
constexpr double kFewestSteps = 8.0;
constexpr double kGoodSteps = 16.0;

struct Start {
  double time = 0.0;  // [s]
  std::string name;
  joints::ScalarMotion motion;
};

void check_bounds(const Start& start, const joints::ScalarLaw& law,
                  SimulationStatistics& statistics) {
  const auto beyond = joints::find_beyond_bound(law, start.motion);
  if (!beyond) return;
  if (beyond->by <= kOnStop * std::max(1.0, std::abs(beyond->bound))) return;
  statistics.events.push_back(
      {start.time, start.name, "starts beyond a stop", start.motion.rate});
  statistics.warnings.push_back(fmt::format(
      "'{}' starts at {:.6g}, {:.3g} beyond its stop at {:g}, which stores "
      "{:.3g} J at once and pushes it back; start it within its limits",
      start.name, start.motion.z, beyond->by, beyond->bound, beyond->energy));
}

// None where the coordinate is undefined: the first step reports that.
template <typename Read>
std::optional<joints::ScalarMotion> find_motion(const Read& read) {
  try {
    return read().motion;
  } catch (const NumericalError&) {
    return std::nullopt;
  }
}

}  // namespace

void add_start_warnings(const SystemModel& model, const SystemState& state,
                        SimulationStatistics& statistics) {
  for (std::size_t c = 0; c < model.couplers.size(); ++c) {
    const Coupler& coupler = model.couplers[c];
    for (const joints::JointElement& element :
         joints::elements_of(coupler.law)) {
      const auto motion = find_motion([&] {
        return evaluate_coordinate(model, state, static_cast<CouplerIndex>(c),
                                   element.coordinate);
      });
      if (!motion) continue;
      check_bounds({state.t, coupler.name, *motion}, element.law, statistics);
    }
  }
  for (std::size_t i = 0; i < model.transmissions.size(); ++i) {
    const Transmission& transmission = model.transmissions[i];
    const auto motion = find_motion([&] {
      return evaluate_transmission(model, state,
                                   static_cast<TransmissionIndex>(i));
    });
    if (!motion) continue;
    for (const joints::ScalarLaw& law : transmission.laws) {
      check_bounds({state.t, transmission.name, *motion}, law, statistics);
    }
  }
}

void add_period_warning(const SystemModel& model,
                        const SimulationSettings& settings, double start,
                        SimulationStatistics& statistics) {
  if (settings.tolerance > 0.0) return;
  const auto oscillations = find_oscillations(model);
  const Oscillation* worst = nullptr;
  double fewest = kFewestSteps;
  double longest = 0.0;
  for (const Oscillation& oscillation : oscillations) {
    const double from = std::max(oscillation.from, start);
    const double until = std::min(oscillation.until, settings.end_time);
    if (!(from < until)) continue;
    const double step = find_longest_step(settings, from, until);
    if (!(oscillation.period < fewest * step * (1.0 - 1e-9))) continue;
    fewest = oscillation.period / step;
    longest = step;
    worst = &oscillation;
  }
  if (worst == nullptr) return;
  statistics.warnings.push_back(fmt::format(
      "{} has a period of {:.3g} s, which steps of {:.3g} s do not follow; "
      "take steps of at most {:.2g} s, or a tolerance",
      worst->name, worst->period, longest, worst->period / kGoodSteps));
}

}  // namespace limber::dynamics
