// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/explicit_limit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "limber/common/errors.hpp"
#include "limber/dynamics/bodies/body.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/integrators/make_integrator.hpp"
#include "limber/dynamics/integrators/stable_step.hpp"
#include "limber/dynamics/simulation/breakpoints.hpp"
#include "limber/dynamics/system/state_increments.hpp"

namespace limber::dynamics {
namespace {

// Largest number of parts of a given step.
constexpr double kMostPartsOfStep = 1e3;
// Preferred fraction of the longest stable step [-]. Runge-Kutta then
// dissipates 4e-6 of the fastest motion's energy a step.
constexpr double kAccurateFraction = 0.1;
// Amplification per step below which a run does not blow up, approximately [-].
constexpr double kMostEnergyGrowth = 1.05;

// A small change of a state, velocities times the step.
struct Change {
  VectorX motion, velocity;  // of all unknowns
  VectorX maxwell;
};

template <typename Visit>
void for_each_vector(const SystemModel& model, Change& x, const Visit& visit) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    for (const UnknownRange& range : list_unknowns(model, b)) {
      const double weight = std::sqrt(range.mass);
      visit(x.motion.segment(range.row, range.size), weight);
      visit(x.velocity.segment(range.row, range.size), weight);
    }
  }
  visit(x.maxwell, 1.0);
}

// The derivative of one step about a state, by finite differences.
class StepDerivative {
 public:
  StepDerivative(const SystemModel& model, const SystemState& state,
                 const SimulationSettings& settings)
      : model_(model),
        state_(state),
        h_(settings.step),
        integrator_(make_integrator(model, settings)),
        end_(take_step(state)) {
    x_ = {make_unknowns(model), make_unknowns(model),
          VectorX::Zero(model.maxwell_count)};
    v_ = v_end_ = make_unknowns(model);
    get_velocities(model, state, v_);
    get_velocities(model, end_, v_end_);
    std::mt19937 random(1);
    for_each_vector(model_, x_, [&](auto&& part, double weight) {
      for (Eigen::Index i = 0; i < part.size(); ++i) {
        part[i] = (static_cast<double>(random()) / 2147483648.0 - 1.0) / weight;
      }
    });
    // Small against every body, large against round-off [kg^1/2 m].
    double least = std::numeric_limits<double>::infinity();
    for (const BodyModel& body : model.bodies) {
      least = std::min(least, std::sqrt(body.J0.trace()));
    }
    increment_ = 1e-7 * least;
  }

  // Another iteration. @returns the growth of the change [-]
  double apply() {
    const double size = measure();
    if (!(size > 0.0)) return 0.0;
    for_each_vector(model_, x_, [&](auto&& part, double) { part /= size; });
    SystemState moved = displace();
    moved = take_step(moved);
    subtract(moved);
    return measure();
  }

 private:
  [[nodiscard]] SystemState take_step(SystemState from) {
    integrator_->start(from, h_);
    integrator_->step(from, h_, from.t + h_);
    return from;
  }

  double measure() {
    double sum = 0.0;
    for_each_vector(model_, x_, [&](const auto& part, double weight) {
      sum += weight * weight * part.squaredNorm();
    });
    return std::sqrt(sum);
  }

  [[nodiscard]] SystemState displace() const {
    const double e = increment_;
    SystemState moved = state_;
    limber::dynamics::displace(model_, x_.motion, e, moved);
    set_velocities(model_, v_ + e / h_ * x_.velocity, moved);
    moved.maxwell += e * x_.maxwell;
    return moved;
  }

  // x <- (moved - end) / e
  void subtract(const SystemState& moved) {
    const double e = increment_;
    x_.motion = find_increments(model_, end_, moved) / e;
    get_velocities(model_, moved, x_.velocity);
    x_.velocity = h_ / e * (x_.velocity - v_end_);
    x_.maxwell = (moved.maxwell - end_.maxwell) / e;
  }

  const SystemModel& model_;
  const SystemState& state_;
  double h_;
  std::unique_ptr<Integrator> integrator_;
  SystemState end_;
  VectorX v_;      // of state_
  VectorX v_end_;  // of end_
  Change x_;
  double increment_ = 0.0;
};

SimulationSettings divide(SimulationSettings settings, double longest) {
  settings.step = std::min(settings.step, longest);
  for (StepChange& change : settings.step_changes) {
    change.step = std::min(change.step, longest);
  }
  return settings;
}

std::string describe(const SystemModel& model, const SystemState& state,
                     IntegratorKind scheme, double step, double longest) {
  return fmt::format(
      "{} is stable up to {:.3g} s here, {:.3g} times less than the step of "
      "{:.3g} s, because of body '{}' and its couplers; ",
      to_string(scheme), longest, step / longest, step,
      model.bodies[find_fastest_body(model, state)].name);
}
constexpr const char* kAdvice =
    "use a step near that, or an implicit integrator";

SimulationSettings limit_central(const SystemModel& model,
                                 const SystemState& state,
                                 const SimulationSettings& requested,
                                 SimulationStatistics& statistics) {
  const double step = find_longest_step(requested);
  statistics.stable_step = find_stable_step(model, state);
  const double longest = kStableFraction * statistics.stable_step;
  if (step > kMostPartsOfStep * longest) {
    throw InputError(
        describe(model, state, requested.integrator, step, longest) + kAdvice);
  }
  return divide(requested, longest);
}

SimulationSettings limit_where_it_grows(const SystemModel& model,
                                        const SystemState& state,
                                        const SimulationSettings& requested,
                                        SimulationStatistics& statistics) {
  const double step = find_longest_step(requested);
  SimulationSettings settings = requested;
  settings.step = step;
  if (find_growth(model, state, settings) < kMostEnergyGrowth) return requested;
  statistics.stable_step = find_stable_step(model, state, requested.integrator);
  const double longest = kStableFraction * statistics.stable_step;
  if (!(step > longest)) return requested;
  if (step > kMostPartsOfStep * longest) {
    statistics.warnings.push_back(
        describe(model, state, requested.integrator, step, longest) +
        "steps are not divided so often, and may blow up; " + kAdvice);
    return requested;
  }
  const double accurate = kAccurateFraction * statistics.stable_step;
  const double taken =
      std::min(longest, std::max(accurate, step / kMostPartsOfStep));
  statistics.warnings.push_back(fmt::format(
      "{} is stable up to {:.3g} s at the start, because of body '{}' and its "
      "couplers: steps of {:.3g} s are divided, into {:.0f} parts",
      to_string(requested.integrator), longest,
      model.bodies[find_fastest_body(model, state)].name, step,
      std::ceil(step / taken * (1.0 - 1e-12))));
  return divide(requested, taken);
}

// Steps are limited by the stiffness that acts at the start.
void warn_of_pairs(const SystemModel& model, const SystemState& state,
                   IntegratorKind scheme, SimulationStatistics& statistics) {
  if (model.pairs.empty() || traits_of(scheme).is_implicit) return;
  SystemTerms terms = make_terms(model);
  calc_terms(model, state, Side::right, terms);
  for (std::size_t i = 0; i < model.pairs.size(); ++i) {
    if (!terms.pairs.responses[i].points().empty()) continue;
    statistics.warnings.push_back(fmt::format(
        "pair '{}' has no points at the start: its stiffness is not known to "
        "{}, whose steps may be too long once it has some",
        model.pairs[i].name, to_string(scheme)));
  }
}

}  // namespace

double find_growth(const SystemModel& model, const SystemState& state,
                   const SimulationSettings& settings) {
  constexpr int kIterations = 100;
  constexpr int kFirst = 50;  // first iteration that counts
  try {
    StepDerivative derivative(model, state, settings);
    double sum = 0.0;
    for (int i = 0; i < kIterations; ++i) {
      const double growth = derivative.apply();
      if (growth == 0.0) return 0.0;
      if (!std::isfinite(growth)) break;
      if (i >= kFirst) sum += std::log(growth);
      if (i + 1 == kIterations) return std::exp(sum / (kIterations - kFirst));
    }
  } catch (const NumericalError&) {  // NOLINT(bugprone-empty-catch)
    // Such a step is too long.
  }
  return std::numeric_limits<double>::infinity();
}

SimulationSettings limit_step(const SystemModel& model,
                              const SystemState& state,
                              const SimulationSettings& requested,
                              SimulationStatistics& statistics) {
  warn_of_pairs(model, state, requested.integrator, statistics);
  switch (traits_of(requested.integrator).limit) {
    case StepLimit::stability:
      return limit_central(model, state, requested, statistics);
    case StepLimit::growth:
      return limit_where_it_grows(model, state, requested, statistics);
    case StepLimit::none:
      break;
  }
  return requested;
}

}  // namespace limber::dynamics
