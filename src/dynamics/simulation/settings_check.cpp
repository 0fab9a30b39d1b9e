// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/simulation.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "common/errors.hpp"
#include "common/names.hpp"
#include "dynamics/energy_verdict.hpp"
#include "dynamics/passes.hpp"
#include "dynamics/run_record.hpp"
#include "dynamics/single_run.hpp"

namespace limber::dynamics {
namespace {

using Clock = std::chrono::steady_clock;

// Those that know no bodies at level `full`.
bool needs_modes(IntegratorKind kind) {
  return kind == IntegratorKind::explicit_euler ||
         kind == IntegratorKind::energy_conserving ||
         kind == IntegratorKind::splitting;
}

void check_settings(const SystemModel& model, const SystemState& state,
                    const SimulationSettings& settings) {
  const auto refuse = [](const std::string& text) { throw InputError(text); };
  if (!(settings.end_time > state.t) || !std::isfinite(settings.end_time)) {
    refuse(fmt::format("duration: the end {:g} s is not after the start {:g} s",
                       settings.end_time, state.t));
  }
  if (!(settings.step > 0.0) || !std::isfinite(settings.step)) {
    refuse(fmt::format("step is {:g} s; expected > 0", settings.step));
  }
  for (std::size_t i = 0; i < settings.step_changes.size(); ++i) {
    const StepChange& change = settings.step_changes[i];
    if (!(change.step > 0.0) || !std::isfinite(change.step)) {
      refuse(fmt::format("step from {:g} s on is {:g} s; expected > 0",
                         change.from, change.step));
    }
    if (i > 0 && !(change.from > settings.step_changes[i - 1].from)) {
      refuse(
          fmt::format("steps change at {:g} s after {:g} s; times must "
                      "increase",
                      change.from, settings.step_changes[i - 1].from));
    }
  }
  if (!(settings.tolerance >= 0.0) || !std::isfinite(settings.tolerance)) {
    refuse(fmt::format("tolerance is {:g} m; expected >= 0, 0 for fixed steps",
                       settings.tolerance));
  }
  if (settings.tolerance > 0.0 &&
      settings.integrator != IntegratorKind::generalized_alpha) {
    refuse(
        "only generalized-alpha takes steps to a tolerance; give a step "
        "instead, or no integrator");
  }
  if (settings.most_steps < 1) {
    refuse(fmt::format("most_steps is {}; expected >= 1", settings.most_steps));
  }
  if (!(settings.rho_inf >= 0.0) || !(settings.rho_inf <= 1.0)) {
    refuse(fmt::format("rho_inf is {:g}; expected 0 to 1", settings.rho_inf));
  }
  if (!(settings.newton_tolerance > 0.0) || settings.newton_iterations < 1) {
    refuse("newton_tolerance and newton_iterations must be > 0");
  }
  if (needs_modes(settings.integrator) && !model.full_bodies.empty()) {
    refuse(fmt::format(
        "body '{}' is at level full, which {} does not integrate; use "
        "generalized-alpha, implicit-euler or central-differences",
        model.bodies[static_cast<std::size_t>(model.full_bodies[0].body)].name,
        integrator_names()[static_cast<std::size_t>(settings.integrator)]));
  }
}

// Adds its own lifetime to `seconds`.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() {
    seconds_ += std::chrono::duration<double>(Clock::now() - begin_).count();
  }

 private:
  double& seconds_;
  Clock::time_point begin_ = Clock::now();
};

}  // namespace

const std::vector<std::string>& integrator_names() {
  static const std::vector<std::string> names = {
      "generalized-alpha", "runge-kutta-4",
      "explicit-euler",    "central-differences",
      "implicit-euler",    "energy-conserving",
      "splitting"};
  return names;
}

IntegratorKind parse_integrator(std::string_view name) {
  return static_cast<IntegratorKind>(
      find_name("integrator", name, integrator_names()));
}

SimulationStatistics simulate(const SystemModel& model, SystemState& state,
                              const SimulationSettings& settings,
                              const Observer& observer,
                              const Progress& progress) {
  SimulationStatistics statistics;
  simulate(model, state, settings, observer, progress, statistics);
  return statistics;
}

void simulate(const SystemModel& model, SystemState& state,
              const SimulationSettings& settings, const Observer& observer,
              const Progress& progress, SimulationStatistics& statistics,
              const Continuation& continuation) {
  RunRecord record;
  simulate(model, state, settings, observer, progress, statistics, continuation,
           {}, record);
}

void simulate(const SystemModel& model, SystemState& state,
              const SimulationSettings& settings, const Observer& observer,
              const Progress& progress, SimulationStatistics& statistics,
              const Continuation& continuation, const Followed& followed,
              RunRecord& record) {
  LIMBER_EXPECT(state.bodies.size() == model.bodies.size());
  LIMBER_EXPECT(state.eta.size() == model.modal_count);
  LIMBER_EXPECT(state.etadot.size() == model.modal_count);
  LIMBER_EXPECT(state.u_H.size() == model.nodal_count);
  LIMBER_EXPECT(state.memory.size() ==
                model.couplers.size() + model.transmissions.size());
  check_settings(model, state, settings);
  const Stopwatch stopwatch(statistics.seconds);
  const auto warn = [&] {
    warn_of_energy(settings.integrator, record.energy, statistics.warnings);
  };
  try {
    if (settings.tolerance > 0.0) {
      run_to_tolerance(model, state, settings, observer, progress, statistics,
                       continuation, followed, record);
    } else {
      run_once(model, state, settings, observer, progress, statistics,
               continuation, followed, record);
    }
  } catch (const NumericalError&) {
    warn();
    throw;
  }
  warn();
  check_energy(settings.integrator, record.energy);
  report(progress, "simulating", 1.0);
}

}  // namespace limber::dynamics
