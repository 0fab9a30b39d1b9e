// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/simulation.hpp"

#include <chrono>

#include "limber/common/errors.hpp"
#include "limber/dynamics/monitors/energy_verdict.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/settings_check.hpp"
#include "limber/dynamics/simulation/single_run.hpp"
#include "limber/dynamics/simulation/tolerance_loop.hpp"

namespace limber::dynamics {
namespace {

using Clock = std::chrono::steady_clock;

// Adds its lifetime to `seconds`.
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
              const SimulationSettings& requested, const Observer& observer,
              const Progress& progress, SimulationStatistics& statistics,
              const Continuation& continuation, const Followed& followed,
              RunRecord& record) {
  check_settings(model, state, requested);
  SimulationSettings settings = requested;
  settings.passes = choose_passes(model, requested, state.t);
  const bool is_verified =
      settings.tolerance > 0.0 && settings.passes == TolerancePasses::verified;
  if (is_verified) {
    refuse_hidden_memory(
        model,
        "a verified tolerance needs several passes; use one pass, or a step");
  }
  if (continuation.keeper.keep || continuation.from) {
    refuse_hidden_memory(model,
                         "a run must continue identically from a checkpoint");
  }
  const Stopwatch stopwatch(statistics.seconds);
  const auto warn = [&] {
    warn_of_energy(settings.integrator, record.energy, statistics.warnings);
  };
  try {
    if (is_verified) {
      run_to_tolerance(model, state, settings, observer, progress, statistics,
                       continuation, followed, record);
    } else {
      statistics.passes = settings.tolerance > 0.0 ? 1 : 0;
      run_once(model, state, settings, observer, progress, statistics,
               continuation, followed, record,
               settings.tolerance > 0.0 ? kOnePassRefinement : 1.0);
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
