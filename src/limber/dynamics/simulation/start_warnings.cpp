// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/start_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/dynamics/equations/coordinate_acceleration.hpp"
#include "limber/dynamics/equations/coupler_motion.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/equations/relative_energy.hpp"
#include "limber/dynamics/simulation/breakpoints.hpp"
#include "limber/dynamics/system/linked_groups.hpp"
#include "limber/dynamics/system/oscillation.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
namespace {

// Excess relative to the size of what moves that counts as none [-].
constexpr double kOnStop = 1e-9;
// Fixed steps in a period: with 8 the mean force in a step errs by up to 5 % of
// the amplitude, with 16 by 1.3 %.
constexpr double kCoarseSteps = 8.0;
constexpr double kGoodSteps = 16.0;

// What an excess along a coordinate z is judged by.
struct Measure {
  double size = 0.0;   // of what moves [unit of z]
  double noise = 0.0;  // of places [unit of z]
};

struct Start {
  double time = 0.0;  // [s]
  std::string name;
  joints::ScalarMotion motion;
  Measure measure;
};

// Radius of gyration and arm of the larger body that moves [m].
double find_moving_size(const SystemModel& model, const Coupler& coupler) {
  double size = 0.0;
  for (const AttachmentIndex f : {coupler.frame_F, coupler.frame_M}) {
    const Attachment& frame = model.attachments[static_cast<std::size_t>(f)];
    if (frame.body == kWorld) continue;
    size = std::max(size, radius_of_gyration(model.bodies[index(frame.body)]) +
                              frame.p_BF.norm());
  }
  return size;
}

// Round-off of the places of a coupler's bodies [m].
double find_place_noise(const SystemModel& model, const SystemState& state,
                        const Coupler& coupler) {
  constexpr double kRoundings = 4.0 * std::numeric_limits<double>::epsilon();
  double place = 0.0;
  for (const BodyIndex b : find_joined_bodies(model, coupler)) {
    if (b != kWorld)
      place = std::max(place, state.bodies[index(b)].p_WB.norm());
  }
  return kRoundings * place;
}

Measure find_measure(const SystemModel& model, const SystemState& state,
                     const Coupler& coupler, int coordinate) {
  const auto& own = joints::coordinates_of(coupler.law)[index(coordinate)];
  if (own.kind == joints::AxisCoordinate::Kind::angle) return {.size = 1.0};
  return {.size = find_moving_size(model, coupler),
          .noise = find_place_noise(model, state, coupler)};
}

// A path's size is its length, which its motion has.
Measure find_measure(const SystemModel& model, const SystemState& state,
                     const Transmission& transmission) {
  Measure sum;
  const auto* joints = std::get_if<JointSum>(&transmission.coordinate);
  if (joints == nullptr) return sum;
  for (const JointSum::Term& term : joints->terms) {
    const Measure one = find_measure(
        model, state, model.couplers[index(term.coupler)], term.coordinate);
    sum.size += std::abs(term.factor) * one.size;
    sum.noise += std::abs(term.factor) * one.noise;
  }
  return sum;
}

// Acceleration of a joint's coordinate in a system at rest.
double find_acceleration(const SystemModel& model, const SystemState& state,
                         CouplerIndex c, int coordinate) {
  SystemTerms terms = make_terms(model);
  calc_terms(model, state, Side::right, terms);
  VectorX accelerations = make_unknowns(model);
  SystemState moving;
  return find_coordinate_acceleration(model, state, terms, c,
                                      static_cast<std::size_t>(coordinate),
                                      accelerations, moving);
}

// Whether a joint at rest beyond its stops stays there, as at an equilibrium.
bool is_balanced(const SystemModel& model, const SystemState& state,
                 CouplerIndex c, const Start& start, int coordinate) {
  constexpr double kBalanced = 1e-3;
  if (start.motion.rate != 0.0 || model.nodal_count > 0) return false;
  SystemState without = state;
  without.memory[index(c)].switches.fill(joints::SwitchMode::off);
  const double with_stops = find_acceleration(model, state, c, coordinate);
  const double of_stops =
      with_stops - find_acceleration(model, without, c, coordinate);
  return std::abs(with_stops) <= kBalanced * std::abs(of_stops);
}

std::optional<joints::BeyondBound> find_excess(const Start& start,
                                               const joints::ScalarLaw& law) {
  const auto beyond = joints::find_beyond_bound(law, start.motion);
  if (!beyond) return std::nullopt;
  const double size = std::max(
      {start.measure.size, std::abs(beyond->bound), std::abs(start.motion.z)});
  if (beyond->by <= kOnStop * size + start.measure.noise) return std::nullopt;
  return beyond;
}

void check_bounds(const Start& start, const joints::ScalarLaw& law,
                  SimulationStatistics& statistics) {
  const auto beyond = find_excess(start, law);
  if (!beyond) return;
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
      const Start start{
          state.t, coupler.name, *motion,
          find_measure(model, state, coupler, element.coordinate)};
      if (find_excess(start, element.law) &&
          is_balanced(model, state, static_cast<CouplerIndex>(c), start,
                      element.coordinate)) {
        continue;
      }
      check_bounds(start, element.law, statistics);
    }
  }
  for (std::size_t i = 0; i < model.transmissions.size(); ++i) {
    const Transmission& transmission = model.transmissions[i];
    const auto motion = find_motion([&] {
      return evaluate_transmission(model, state,
                                   static_cast<TransmissionIndex>(i));
    });
    if (!motion) continue;
    const Start start{state.t, transmission.name, *motion,
                      find_measure(model, state, transmission)};
    for (const joints::ScalarLaw& law : transmission.laws) {
      check_bounds(start, law, statistics);
    }
  }
}

void add_period_warning(const SystemModel& model,
                        const SimulationSettings& settings, double start,
                        SimulationStatistics& statistics) {
  if (settings.tolerance > 0.0) return;
  const auto oscillations = find_oscillations(model);
  const Oscillation* worst = nullptr;
  double fewest = kCoarseSteps;
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
      "{} has a period of {:.3g} s, which steps of {:.3g} s do not follow; use "
      "steps of at most {:.2g} s, or a tolerance",
      worst->name, worst->period, longest, worst->period / kGoodSteps));
}

}  // namespace limber::dynamics
