// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "common/errors.hpp"
#include "common/names.hpp"
#include "dynamics/exact_modes.hpp"
#include "dynamics/landmarks.hpp"
#include "dynamics/marcher.hpp"
#include "dynamics/modal_loads.hpp"
#include "dynamics/stable_step.hpp"

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

// What the loads and the dampers did since the start [J].
struct Losses {
  double work = 0.0;
  double dissipated = 0.0;
};

// Called with the state at the start, if that is asked for, and at outputs.
using Visit = std::function<void(const SystemState&, const Losses&)>;

struct Timeline {
  double start = 0.0;
  bool starts_with_output = false;
  std::vector<Landmark> marks;
};

Timeline find_timeline(const SystemModel& model, double start,
                       const SimulationSettings& settings) {
  const auto& outputs = settings.output_times;
  return {start, !outputs.empty() && outputs.front() <= start,
          find_landmarks(model, start, settings)};
}

std::vector<double> find_visited_times(const Timeline& timeline) {
  std::vector<double> times;
  if (timeline.starts_with_output) times.push_back(timeline.start);
  for (const Landmark& mark : timeline.marks) {
    if (mark.is_output) times.push_back(mark.time);
  }
  return times;
}

// Steps no longer than central differences are stable for.
SimulationSettings limit_step(const SystemModel& model,
                              const SystemState& state,
                              const SimulationSettings& asked,
                              SimulationStatistics& statistics) {
  if (asked.integrator != IntegratorKind::central_differences) return asked;
  SimulationSettings settings = asked;
  statistics.stable_step = find_stable_step(model, state);
  const double longest = kStableShare * statistics.stable_step;
  settings.step = std::min(asked.step, longest);
  for (StepChange& change : settings.step_changes) {
    change.step = std::min(change.step, longest);
  }
  return settings;
}

// Takes the steps.
void integrate(const SystemModel& model, SystemState& state,
               const SimulationSettings& settings, const Timeline& timeline,
               const Visit& visit, const Progress& progress,
               SimulationStatistics& statistics) {
  Marcher marcher(model, settings, statistics.events);
  const double start = timeline.start;
  const auto losses = [&] {
    return Losses{marcher.totals().load_work, marcher.totals().dissipated};
  };
  const auto count_costs = [&](const StepResult& since) {
    const StepResult& now = marcher.totals();
    statistics.newton_iterations += now.iterations - since.iterations;
    statistics.factorizations += now.factorizations - since.factorizations;
  };
  if (timeline.starts_with_output) visit(state, losses());
  bool started = false;
  bool at_jump = false;
  for (const Landmark& mark : timeline.marks) {
    const double origin = state.t;
    const double span = mark.time - origin;
    const double longest = find_longest_step(settings, origin);
    const auto count =
        static_cast<long>(std::ceil(span / longest * (1.0 - 1e-12)));
    const double h = span / static_cast<double>(std::max(count, 1L));
    if (!started) marcher.start(state, h);
    if (at_jump) marcher.cross_jump(state, h);
    started = true;
    for (long i = 1; i <= count; ++i) {
      // Times come from the landmark, not from a sum of steps.
      const double end =
          i == count ? mark.time : origin + static_cast<double>(i) * h;
      const StepResult before = marcher.totals();
      marcher.step(state, h, end);
      count_costs(before);
      if (++statistics.steps % 64 == 0 && progress) {
        progress("simulating", (state.t - start) / (settings.end_time - start));
      }
    }
    at_jump = mark.is_jump;
    if (mark.is_output) visit(state, losses());
  }
}

// Nothing is left that needs steps.
void pass_time(SystemState& state, const Timeline& timeline,
               const Visit& visit) {
  if (timeline.starts_with_output) visit(state, {});
  for (const Landmark& mark : timeline.marks) {
    state.t = mark.time;
    if (mark.is_output) visit(state, {});
  }
}

bool has_exact_modes(const SystemModel& model,
                     const SimulationSettings& settings) {
  if (!settings.exact_modes ||
      settings.integrator == IntegratorKind::explicit_euler) {
    return false;
  }
  for (BodyIndex b = 0; b < std::ssize(model.bodies); ++b) {
    if (has_closed_modal_loads(model, b)) return true;
  }
  return false;
}

// Modes in closed form beside steps for the rest.
void integrate_with_exact_modes(ExactModes& exact, SystemState& state,
                                const SimulationSettings& settings,
                                const Timeline& timeline, const Visit& visit,
                                const Progress& progress,
                                SimulationStatistics& statistics) {
  statistics.exact_modes = exact.count();
  exact.prepare(find_visited_times(timeline));
  SystemState rest = exact.take_rest(state);
  SystemState whole = state;
  std::size_t visited = 0;
  const Visit visit_whole = [&](const SystemState& now, const Losses& losses) {
    exact.join(now, visited, whole);
    const ExactModes::Losses own = exact.losses(visited);
    visit(whole, {losses.work + own.work, losses.dissipated + own.dissipated});
    ++visited;
  };
  const auto leave = [&] {
    exact.prepare({rest.t});
    exact.join(rest, 0, state);
  };
  try {
    if (exact.has_motion_left()) {
      integrate(exact.rest(), rest, settings, timeline, visit_whole, progress,
                statistics);
    } else {
      pass_time(rest, timeline, visit_whole);
    }
  } catch (const NumericalError&) {
    leave();
    throw;
  }
  leave();
}

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
              const SimulationSettings& asked, const Observer& observer,
              const Progress& progress, SimulationStatistics& statistics) {
  LIMBER_EXPECT(state.bodies.size() == model.bodies.size());
  LIMBER_EXPECT(state.eta.size() == model.modal_count);
  LIMBER_EXPECT(state.etadot.size() == model.modal_count);
  LIMBER_EXPECT(state.u_H.size() == model.nodal_count);
  check_settings(model, state, asked);

  const Stopwatch stopwatch(statistics.seconds);
  SystemTerms terms = make_terms(model);
  SystemState framed;
  const Visit visit = [&](const SystemState& at, const Losses& losses) {
    if (!observer) return;
    if (!model.full_bodies.empty()) {
      framed = at;
      update_mean_frames(model, framed);
    }
    const SystemState& now = model.full_bodies.empty() ? at : framed;
    EnergyBalance balance = calc_energy(model, now, terms);
    balance.dissipated = losses.dissipated;
    balance.work = losses.work;
    observer(now, balance);
  };
  const SimulationSettings settings =
      limit_step(model, state, asked, statistics);
  const Timeline timeline = find_timeline(model, state.t, settings);
  const double start = state.t;
  const auto finish = [&] {
    update_mean_frames(model, state);
    add_load_edges(model, start, state.t, statistics.events);
  };
  try {
    if (has_exact_modes(model, settings)) {
      ExactModes exact(model, state);
      integrate_with_exact_modes(exact, state, settings, timeline, visit,
                                 progress, statistics);
    } else {
      integrate(model, state, settings, timeline, visit, progress, statistics);
    }
  } catch (const NumericalError&) {
    finish();
    throw;
  }
  finish();
  report(progress, "simulating", 1.0);
}

}  // namespace limber::dynamics
