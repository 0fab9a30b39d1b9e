// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/start_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "common/errors.hpp"
#include "dynamics/coupler_motion.hpp"

namespace limber::dynamics {
namespace {

// Of the rest of a coordinate's size: nearer to a stop is on it.
constexpr double kOnStop = 1e-9;

struct Start {
  double time = 0.0;  // [s]
  std::string name;
  joints::ScalarMotion motion;
};

void check_stop(const Start& start, const joints::ScalarLaw& law,
                SimulationStatistics& statistics) {
  const auto* stop = std::get_if<joints::EndStop>(&law);
  if (stop == nullptr) return;
  const auto& p = stop->parameters();
  const double z = start.motion.z;
  const bool is_above = z > p.upper;
  if (!is_above && !(z < p.lower)) return;
  const double bound = is_above ? p.upper : p.lower;
  const double beyond = is_above ? z - bound : bound - z;
  if (beyond <= kOnStop * std::max(1.0, std::abs(bound))) return;
  const double energy = stop->evaluate(start.motion).energy;
  statistics.events.push_back(
      {start.time, start.name, "starts beyond a stop", start.motion.rate});
  statistics.warnings.push_back(fmt::format(
      "'{}' starts at {:.6g}, {:.3g} beyond its stop at {:g}, which stores "
      "{:.3g} J at once and pushes it back; start it within its limits",
      start.name, z, beyond, bound, energy));
}

}  // namespace

void add_start_warnings(const SystemModel& model, const SystemState& state,
                        SimulationStatistics& statistics) {
  for (std::size_t c = 0; c < model.couplers.size(); ++c) {
    const auto* joint = std::get_if<joints::Joint>(&model.couplers[c].law);
    if (joint == nullptr) continue;
    for (const joints::JointElement& element : joint->elements()) {
      if (!std::holds_alternative<joints::EndStop>(element.law)) continue;
      try {
        const CoordinateReading reading = evaluate_coordinate(
            model, state, static_cast<CouplerIndex>(c), element.coordinate);
        check_stop({state.t, model.couplers[c].name, reading.motion},
                   element.law, statistics);
      } catch (const NumericalError&) {  // NOLINT(bugprone-empty-catch)
        // Its first step says so.
      }
    }
  }
  for (std::size_t i = 0; i < model.transmissions.size(); ++i) {
    const Transmission& transmission = model.transmissions[i];
    for (const joints::ScalarLaw& law : transmission.laws) {
      if (!std::holds_alternative<joints::EndStop>(law)) continue;
      const CoordinateReading reading = evaluate_transmission(
          model, state, static_cast<TransmissionIndex>(i));
      check_stop({state.t, transmission.name, reading.motion}, law, statistics);
    }
  }
}

}  // namespace limber::dynamics
