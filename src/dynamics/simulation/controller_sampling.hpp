// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Takes the samples of a system's controllers. All that the next sample
/// depends on is in the state.
class ControllerSampling {
 public:
  /// @param same samples that are later by no more are taken, too [s]
  ControllerSampling(const SystemModel& model, double same);

  /// Leaves out samples before a run that starts at `state`.
  void skip_until(SystemState& state) const;

  struct Change {
    bool has_jump = false;  ///< an input or its rate
    /// By which the energy in the springs of position drives changed [J].
    double work = 0.0;
  };
  /// Takes all samples that are due. Controllers that are sampled at one time
  /// see the same state.
  /// @throws NumericalError naming the controller, the input and the time if it
  /// throws or writes what is not finite; `state` is then unchanged.
  /// Interrupted if it throws that.
  Change take(SystemState& state);

 private:
  // A coupler, or a transmission after all couplers, whose drives follow
  // inputs.
  using Link = std::size_t;

  void find_links();
  void sample(std::size_t controller, const SystemState& seen,
              SystemState& state);
  void write(const ControllerModel& controller, SystemState& state) const;
  [[nodiscard]] double calc_energy(const SystemState& state) const;

  const SystemModel& model_;
  double same_;
  std::vector<Link> links_;
  std::vector<std::size_t> due_;
  SystemState seen_;
  std::vector<double> measured_;
  std::vector<double> written_;
};

}  // namespace limber::dynamics
