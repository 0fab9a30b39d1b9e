// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/dynamics/equations/energy_flows.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Samples a system's controllers. The next sample depends on the state
/// only.
class ControllerSampling {
 public:
  /// @param start of the run [s]: samples later than the present only by the
  /// round-off of times are due
  ControllerSampling(const SystemModel& model, double start);

  /// Skips samples before a run that starts at `state`.
  void skip_until(SystemState& state) const;

  /// Takes all due samples. Controllers sampled at the same time see the same
  /// state.
  /// @returns whether an input or its rate jumps
  /// @throws NumericalError naming the controller, the input and the time if it
  /// throws or writes a value that is not finite; `state` is then unchanged.
  /// Interrupted if it throws that.
  bool take(SystemState& state);
  /// Changes of the energy in the springs of position drives by the last ones.
  [[nodiscard]] const EnergyFlows& flows() const { return flows_; }

  /// Makes the samples that controllers with an ExternalLaw took at the present
  /// time due again.
  /// @returns whether there are any
  bool repeat_external(SystemState& state) const;

 private:
  // A coupler, or a transmission after all couplers, whose drives follow
  // inputs.
  using Link = std::size_t;

  void find_links();
  void sample(std::size_t controller, const SystemState& seen,
              SystemState& state);
  void write(const ControllerModel& controller, SystemState& state) const;
  [[nodiscard]] double calc_energy(Link link, const SystemState& state) const;

  const SystemModel& model_;
  double start_;  // [s]
  std::vector<Link> links_;
  EnergyFlows flows_;
  std::vector<std::size_t> due_;
  SystemState seen_;
  std::vector<double> measured_;
  std::vector<double> written_;
};

}  // namespace limber::dynamics
