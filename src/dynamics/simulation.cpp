// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <variant>

#include "common/errors.hpp"
#include "common/names.hpp"
#include "dynamics/explicit_euler.hpp"
#include "dynamics/generalized_alpha.hpp"
#include "dynamics/runge_kutta.hpp"

namespace limber::dynamics {
namespace {

using Clock = std::chrono::steady_clock;

// A time that a step must end on.
struct Landmark {
  double time = 0.0;
  bool is_jump = false;
  bool is_output = false;
};

void check_settings(const SystemState& state,
                    const SimulationSettings& settings) {
  const auto refuse = [](const std::string& text) { throw InputError(text); };
  if (!(settings.end_time > state.t) || !std::isfinite(settings.end_time)) {
    refuse(fmt::format("duration: the end {:g} s is not after the start {:g} s",
                       settings.end_time, state.t));
  }
  if (!(settings.step > 0.0) || !std::isfinite(settings.step)) {
    refuse(fmt::format("step is {:g} s; expected > 0", settings.step));
  }
  if (!(settings.rho_inf >= 0.0) || !(settings.rho_inf <= 1.0)) {
    refuse(fmt::format("rho_inf is {:g}; expected 0 to 1", settings.rho_inf));
  }
  if (!(settings.newton_tolerance > 0.0) || settings.newton_iterations < 1) {
    refuse("newton_tolerance and newton_iterations must be > 0");
  }
}

std::vector<Landmark> find_landmarks(const SystemModel& model, double start,
                                     const SimulationSettings& settings) {
  std::vector<Landmark> marks;
  for (const double t : settings.output_times) {
    if (t > start && t <= settings.end_time) marks.push_back({t, false, true});
  }
  for (const Load& load : model.loads) {
    for (const double t : break_times(load.function)) {
      if (t > start && t < settings.end_time) marks.push_back({t, true, false});
    }
  }
  for (const BodyLoad& load : model.body_loads) {
    for (const double t : load.history.times) {
      if (t > start && t < settings.end_time) marks.push_back({t, true, false});
    }
  }
  marks.push_back({settings.end_time, false, false});
  std::stable_sort(
      marks.begin(), marks.end(),
      [](const Landmark& a, const Landmark& b) { return a.time < b.time; });
  // Times that differ by round-off alone are one. A jump's time wins, so that
  // the load's own comparison with it is exact.
  const double same = 1e-12 * std::max(std::abs(start), settings.end_time);
  std::vector<Landmark> merged;
  for (const Landmark& mark : marks) {
    if (merged.empty() || mark.time - merged.back().time > same) {
      merged.push_back(mark);
      continue;
    }
    Landmark& last = merged.back();
    if (mark.is_jump) last.time = mark.time;
    last.is_jump |= mark.is_jump;
    last.is_output |= mark.is_output;
  }
  return merged;
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

// The integrators behind one face.
class Stepper {
 public:
  Stepper(const SystemModel& model, const SimulationSettings& settings)
      : scheme_(make(model, settings)) {}

  void start(const SystemState& state, double h) {
    if (auto* alpha = std::get_if<GeneralizedAlpha>(&scheme_)) {
      alpha->start(state, h);
    }
  }
  void cross_jump(const SystemState& state, double h) {
    if (auto* alpha = std::get_if<GeneralizedAlpha>(&scheme_)) {
      alpha->cross_jump(state, h);
    }
  }
  StepResult step(SystemState& state, double h, double end) {
    return std::visit([&](auto& s) { return s.step(state, h, end); }, scheme_);
  }

 private:
  using Scheme = std::variant<GeneralizedAlpha, RungeKutta4, ExplicitEuler>;
  static Scheme make(const SystemModel& model,
                     const SimulationSettings& settings) {
    if (settings.integrator == IntegratorKind::runge_kutta_4) {
      return RungeKutta4(model);
    }
    if (settings.integrator == IntegratorKind::explicit_euler) {
      return ExplicitEuler(model);
    }
    return GeneralizedAlpha(model, {settings.rho_inf, settings.newton_tolerance,
                                    settings.newton_iterations});
  }
  Scheme scheme_;
};

}  // namespace

const std::vector<std::string>& integrator_names() {
  static const std::vector<std::string> names = {
      "generalized-alpha", "runge-kutta-4", "explicit-euler"};
  return names;
}

IntegratorKind parse_integrator(std::string_view name) {
  const auto& names = integrator_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw InputError(describe_unknown("integrator", name, names));
  }
  return static_cast<IntegratorKind>(found - names.begin());
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
              const Progress& progress, SimulationStatistics& statistics) {
  LIMBER_EXPECT(state.bodies.size() == model.bodies.size());
  LIMBER_EXPECT(state.eta.size() == model.modal_count);
  LIMBER_EXPECT(state.etadot.size() == model.modal_count);
  check_settings(state, settings);

  const double start = state.t;
  const std::vector<Landmark> marks = find_landmarks(model, start, settings);
  double dissipated = 0.0;
  double work = 0.0;
  const auto observe = [&] {
    if (!observer) return;
    EnergyBalance balance = calc_energy(model, state);
    balance.dissipated = dissipated;
    balance.work = work;
    observer(state, balance);
  };
  if (!settings.output_times.empty() && settings.output_times[0] <= start) {
    observe();
  }

  const Stopwatch stopwatch(statistics.seconds);
  long steps = 0;
  Stepper stepper(model, settings);
  bool started = false;
  bool at_jump = false;
  for (const Landmark& mark : marks) {
    const double origin = state.t;
    const double span = mark.time - origin;
    const auto count =
        static_cast<long>(std::ceil(span / settings.step * (1.0 - 1e-12)));
    const double h = span / static_cast<double>(std::max(count, 1L));
    if (!started) stepper.start(state, h);
    if (at_jump) stepper.cross_jump(state, h);
    started = true;
    for (long i = 1; i <= count; ++i) {
      // Times come from the landmark, not from a sum of steps.
      const double end =
          i == count ? mark.time : origin + static_cast<double>(i) * h;
      const StepResult result = stepper.step(state, h, end);
      ++statistics.steps;
      statistics.newton_iterations += result.iterations;
      statistics.factorizations += result.factorizations;
      dissipated += result.dissipated;
      work += result.load_work;
      if (progress && ++steps % 64 == 0) {
        progress("simulating", (state.t - start) / (settings.end_time - start));
      }
    }
    at_jump = mark.is_jump;
    if (mark.is_output) observe();
  }
  report(progress, "simulating", 1.0);
}

}  // namespace limber::dynamics
