// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/equilibrium.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/analysis/static_newton.hpp"
#include "limber/dynamics/analysis/stiff_joints.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/dynamics/integrators/generalized_alpha.hpp"
#include "limber/dynamics/newton/force_balance.hpp"
#include "limber/dynamics/newton/newton_measures.hpp"
#include "limber/dynamics/simulation/breakpoints.hpp"
#include "limber/dynamics/system/state_increments.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
namespace {

/// Stores joint angles with full turns in the couplers' memory, and what pairs
/// remember.
void remember_angles(const SystemModel& model, SystemState& state) {
  for (std::size_t c = 0; c < model.couplers.size(); ++c) {
    const auto& coordinates = joints::coordinates_of(model.couplers[c].law);
    if (coordinates.empty()) continue;
    const joints::RelativeMotion motion =
        find_relative_motion(model, state, static_cast<CouplerIndex>(c));
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      double& near = state.memory[c].near[i];
      near = joints::find_position(coordinates[i], motion, near);
    }
  }
  PairCommit{model}(state);
}

/// Names the coupler whose force is rounded most, if by more than a millionth
/// of the acting force [N]; else empty.
std::string describe_coupler_rounding(const SystemModel& model,
                                      const SystemTerms& terms, double acting) {
  constexpr double kRounded = 1e-6;
  std::vector<Vector6> gaps;
  find_roundoff_gaps(model, terms, 0.0, gaps);
  double worst = kRounded * acting;
  std::string text;
  for (std::size_t c = 0; c < terms.couplers.size(); ++c) {
    const double noise = gaps[c].head<3>().norm();
    if (!(noise > worst)) continue;
    worst = noise;
    text = fmt::format(
        "Round-off of positions changes the force of coupler '{}' by {:.2g} N, "
        "where {:.3g} N act: it is too stiff to be solved; make it softer",
        model.couplers[c].name, noise, acting);
  }
  return text;
}

bool try_solve(StaticNewton& newton, const VectorX& target,
               const StaticNewton::Settings& settings, SystemState& state) {
  try {
    return newton.solve(target, settings, state);
  } catch (const NumericalError&) {
    return false;  // an element was inverted
  }
}

/// Load stepping.
class Continuation {
 public:
  Continuation(const SystemModel& model, StaticNewton& newton,
               const EquilibriumSettings& settings)
      : model_(model), newton_(newton), settings_(settings) {}

  int run(const VectorX& unbalanced, SystemState& state,
          const Progress& progress) {
    constexpr double kOnTheWay = 1e-6;
    constexpr int kEasy = 6;  // most iterations after which the load step grows
    double reached = 0.0;
    double step = settings_.largest_fraction;
    int steps = 0;
    while (reached < 1.0) {
      const double next = std::min(1.0, reached + step);
      SystemState trial = state;
      const int before = newton_.iterations();
      const double tolerance = next < 1.0 ? kOnTheWay : settings_.tolerance;
      if (try_solve(newton_, (1.0 - next) * unbalanced,
                    {tolerance, settings_.newton_iterations}, trial)) {
        remember_angles(model_, trial);
        state = std::move(trial);
        reached = next;
        ++steps;
        report(progress, "equilibrium", reached);
        if (newton_.iterations() - before <= kEasy) {
          step = std::min(2.0 * step, settings_.largest_fraction);
        }
        continue;
      }
      step = 0.5 * (next - reached);
      if (step < settings_.smallest_fraction)
        fail(reached, newton_.lengths().measure_forces(unbalanced).maxCoeff());
    }
    return steps;
  }

 private:
  [[noreturn]] void fail(double reached, double acting) const {
    const auto b = static_cast<std::size_t>(newton_.most_moved());
    const std::string cause =
        describe_coupler_rounding(model_, newton_.terms(), acting);
    throw NumericalError(fmt::format(
        "body '{}': no equilibrium beyond {:.4g} of the unbalanced forces at "
        "the start. {}",
        model_.bodies[b].name, reached,
        !cause.empty()
            ? cause
            : "There is a limit point, or unconstrained motion; relaxation may "
              "find a more distant equilibrium"));
  }

  const SystemModel& model_;
  StaticNewton& newton_;
  const EquilibriumSettings& settings_;
};

/// Dynamic relaxation to an equilibrium, with the loads of the start's time.
class Fall {
 public:
  Fall(const SystemModel& model, double step)
      : model_(model),
        scheme_(model, {.tolerance = kTolerance, .implicit_euler = true}),
        step_(step) {}

  /// Runs until `near` is true for a state at a peak of kinetic energy.
  template <typename Near>
  int run(SystemState& state, int most, const Near& near) {
    scheme_.start(state, step_);
    double kinetic = 0.0;
    for (int steps = 1; steps <= most; ++steps) {
      try {
        (void)scheme_.step(state, step_, state.t);
      } catch (const NumericalError&) {
        step_ *= 0.5;
        restart(state);
        kinetic = 0.0;
        continue;
      }
      remember_angles(model_, state);
      const EnergyBalance energy = calc_energy(model_, state);
      const double now = energy.kinetic_rigid + energy.kinetic_modal;
      const bool is_peak = !(now > kinetic);
      kinetic = now;
      if (!is_peak) continue;
      restart(state);
      kinetic = 0.0;
      if (near(state)) return steps;
    }
    throw NumericalError(fmt::format(
        "relaxation: no equilibrium after {} steps of {:.3g} s", most, step_));
  }

 private:
  static constexpr double kTolerance = 1e-6;
  void restart(SystemState& state) {
    state = stop(state);
    scheme_.start(state, step_);
  }

  const SystemModel& model_;
  GeneralizedAlpha scheme_;
  double step_;
};

/// Without loads, unstressed couplers have only round-off of their wrenches.
bool is_balanced(const SystemModel& model, StaticNewton& newton,
                 const SystemState& state) {
  constexpr double kNothing = 1e-9;  // of the extents
  for (const Load& load : model.loads) {
    if (evaluate(load.function, now_of(state)) != 0.0) return false;
  }
  if (!model.body_loads.empty() || !model.gravity_W.isZero(0.0)) return false;
  return newton.measure_slow_step(state) <= kNothing;
}

int relax(const SystemModel& model, StaticNewton& newton,
          const EquilibriumSettings& settings, SystemState& state) {
  constexpr double kNear = 0.1;  // of the extents, to a peak's equilibrium
  constexpr double kSteps = 0.1;
  const VectorX balanced = VectorX::Zero(count_unknowns(model));
  const double time = 1.0 / std::sqrt(newton.lengths().measure_acceleration(
                                newton.calc_forces_left(state)));
  const double t = state.t;
  // The scheme evaluates loads before their edges.
  state.t = find_time_after(t);
  Fall fall(model, kSteps * time);
  const int steps =
      fall.run(state, settings.relaxation_steps, [&](SystemState& at) {
        SystemState trial = at;
        trial.t = t;
        if (!try_solve(newton, balanced,
                       {settings.tolerance, settings.newton_iterations},
                       trial) ||
            newton.lengths().measure(find_increments(model, at, trial)) >
                kNear) {
          return false;
        }
        at = trial;
        return true;
      });
  state.t = t;
  return steps;
}

}  // namespace

const std::vector<std::string>& equilibrium_method_names() {
  static const std::vector<std::string> names = {"newton", "relaxation"};
  return names;
}

EquilibriumMethod parse_equilibrium_method(std::string_view name) {
  return static_cast<EquilibriumMethod>(
      find_name("method", name, equilibrium_method_names()));
}

Equilibrium find_equilibrium(const SystemModel& model, const SystemState& start,
                             const EquilibriumSettings& settings,
                             const Progress& progress) {
  if (const auto stiff = replace_ideal_joints(model)) {
    Equilibrium found = find_equilibrium(*stiff, start, settings, progress);
    EquilibriumSettings near = settings;
    near.method = EquilibriumMethod::newton;
    found.state = solve_without_deflection(
        model, *stiff, std::move(found.state), [&](const SystemState& from) {
          return find_equilibrium(*stiff, from, near).state;
        });
    return found;
  }
  if (!model.pairs.empty()) {
    throw InputError(fmt::format(
        "pair '{}': static equilibrium with pairs is not supported; use "
        "couplers, or simulate with damping until the motion ends",
        model.pairs[0].name));
  }
  Equilibrium found;
  found.state = stop(start);
  StaticNewton newton(model, found.state);
  found.extent = newton.lengths().largest_extent();
  const VectorX unbalanced = newton.calc_forces_left(found.state);
  check_balance(model, found.state, newton.terms());
  if (unbalanced.isZero(0.0) || is_balanced(model, newton, found.state)) {
    return found;
  }
  if (settings.method == EquilibriumMethod::relaxation) {
    found.relaxation_steps = relax(model, newton, settings, found.state);
    found.load_steps = 1;
  } else {
    Continuation continuation(model, newton, settings);
    found.load_steps = continuation.run(unbalanced, found.state, progress);
  }
  update_mean_frames(model, found.state);
  found.newton_iterations = newton.iterations();
  found.distance = newton.lengths().measure_length(
      find_increments(model, stop(start), found.state));
  report(progress, "equilibrium", 1.0);
  return found;
}

}  // namespace limber::dynamics
