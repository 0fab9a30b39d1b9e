// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/progress.hpp"
#include "dynamics/checkpoint.hpp"
#include "dynamics/energy.hpp"
#include "dynamics/event.hpp"
#include "dynamics/system_model.hpp"
#include "dynamics/system_state.hpp"

namespace limber::dynamics {

enum class IntegratorKind {
  generalized_alpha,
  runge_kutta_4,
  explicit_euler,
  central_differences,  ///< divides steps that are too long to be stable
  implicit_euler,
  energy_conserving,
  splitting,
};

/// "generalized-alpha", "runge-kutta-4", "explicit-euler",
/// "central-differences", "implicit-euler", "energy-conserving", "splitting".
[[nodiscard]] const std::vector<std::string>& integrator_names();
/// @throws InputError naming the nearest integrator.
[[nodiscard]] IntegratorKind parse_integrator(std::string_view name);

/// From a time on, another longest step.
struct StepChange {
  double from = 0.0;  ///< [s]
  double step = 0.0;  ///< > 0 [s]
};

struct SimulationSettings {
  IntegratorKind integrator = IntegratorKind::generalized_alpha;
  double end_time = 0.0;  ///< > start [s]
  double step = 0.0;      ///< longest step, > 0 [s]
  /// Steps of any length up to `step`, such that no point of a body is farther
  /// from where it should be than this at any output time; 0: steps of `step`
  /// [m]. By generalized_alpha alone.
  double tolerance = 0.0;
  /// To a tolerance, at most, over all passes; those taken again count, too.
  long most_steps = 5'000'000;
  std::vector<StepChange> step_changes = {};  ///< at increasing times
  std::vector<double> output_times = {};  ///< increasing, in [start, end] [s]
  double rho_inf = 0.9;                   ///< spectral radius at infinity [0,1]
  double newton_tolerance = 1e-12;        ///< of a step's motion [-]
  int newton_iterations = 20;             ///< at most, a step
  /// Modes of `uncoupled` bodies that only known loads drive are answered in
  /// closed form, without steps (not by explicit_euler, which samples loads).
  bool exact_modes = true;
};

struct SimulationStatistics {
  long steps = 0;
  long rejected_steps = 0;  ///< of a tolerance
  long halved_steps = 0;    ///< that did not go through whole
  int passes = 0;           ///< over the whole time, of a tolerance
  /// Of a tolerance: how far a point is from where it should be, at most [m].
  double estimated_error = 0.0;
  long newton_iterations = 0;
  long factorizations = 0;
  long linear_solves = 0;    ///< of implicit schemes, in steps that failed, too
  int exact_modes = 0;       ///< modes answered in closed form
  double stable_step = 0.0;  ///< of central differences, if found [s]
  double seconds = 0.0;      ///< wall time of the stepping [s]
  std::vector<Event> events;  ///< in the order of time
  std::vector<std::string> warnings;
};

/// Called at every output time with the state and the balance so far.
using Observer = std::function<void(const SystemState&, const EnergyBalance&)>;

/// Carries `state` to the end time. Steps land on output times and on every
/// load discontinuity exactly, and on what happens at couplers to the order of
/// the integrator. What needs no steps takes none. On
/// NumericalError `state` holds the last good step, and everything up to there
/// was observed.
/// @throws InputError for settings outside their range; NumericalError naming
/// the body and the time.
SimulationStatistics simulate(const SystemModel& model, SystemState& state,
                              const SimulationSettings& settings,
                              const Observer& observer,
                              const Progress& progress = {});

/// A run that leaves checkpoints, or goes on from one.
struct Continuation {
  CheckpointKeeper keeper = {};
  /// Made with the same model, state and settings.
  std::optional<Checkpoint> from = {};
};

/// The same, adding to `statistics`, which tells the cost also of a run that
/// ends in a NumericalError. With `continuation.from` the observer is not
/// called again for the outputs before it; of steps to a tolerance it is, all
/// at the end.
/// @param state that at the start in every case
/// @throws InputError also for a checkpoint that is damaged.
void simulate(const SystemModel& model, SystemState& state,
              const SimulationSettings& settings, const Observer& observer,
              const Progress& progress, SimulationStatistics& statistics,
              const Continuation& continuation = {});

}  // namespace limber::dynamics
