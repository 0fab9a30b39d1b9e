// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <stop_token>

#include "limber/dynamics/integrators/simulation_settings.hpp"
#include "limber/dynamics/simulation/checkpoint.hpp"
#include "limber/dynamics/simulation/simulation_statistics.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/dynamics/terms/energy_balance.hpp"

namespace limber::dynamics {

/// A simulation that the caller advances, to read its state in between or to
/// end it early. simulate() (simulation.hpp) takes the same steps in one call.
///
/// Limits     all modes are integrated, none solved in closed form; a tolerance
///            bounds the error of each step, whereas simulate() repeats the run
///            until it bounds the error at every output. With
///            TolerancePasses::one steps are those of simulate() to the bit
class Simulator {
 public:
  /// @param model must outlive the simulator
  /// @param settings steps end on output_times; end_time is the latest time
  /// @throws InputError for settings outside their range.
  Simulator(const SystemModel& model, const SystemState& start,
            const SimulationSettings& settings);
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;
  ~Simulator();

  /// Advances exactly to t [s], shortening the last step if needed.
  /// @returns whether t was reached; false if `stop` was requested, which takes
  /// effect after the current step
  /// @throws InputError for a time before the state's or after end_time;
  /// NumericalError naming the body or coupler and the time (the state is then
  /// that of the last good step), also at end_time if more than half of the
  /// energy does not balance.
  bool advance_to(double t, const std::stop_token& stop = {});
  /// The same; `stops` is called before every step and returns whether to stop.
  bool advance_to(double t, const std::function<bool()>& stops);

  /// Sets the output of all controllers with an ExternalLaw, from their next
  /// samples on. Samples that were taken at the present time are taken again,
  /// so that these then are as if the output had been known before.
  /// @param values one for each of their ControllerModel::writes, in the order
  /// of the model [unit of the input]
  /// @throws InputError for another number of values; NumericalError naming the
  /// controller for a value that is not finite.
  void set_external_outputs(std::span<const double> values);

  [[nodiscard]] const SystemState& state() const;
  /// Current energies and momenta, work and dissipation since the start.
  [[nodiscard]] EnergyBalance calc_energy() const;
  /// Steps, costs, events and warnings so far.
  [[nodiscard]] const SimulationStatistics& statistics() const;

  /// Saves the simulation. It continues from here identically, to the bit, to
  /// one that restores the checkpoint.
  /// @throws InputError for a controller with hidden memory.
  [[nodiscard]] Checkpoint save();
  /// @param checkpoint of a simulator with the same model, start and settings
  /// @throws InputError for a checkpoint that is damaged, a controller with
  /// hidden memory.
  void restore(const Checkpoint& checkpoint);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace limber::dynamics
