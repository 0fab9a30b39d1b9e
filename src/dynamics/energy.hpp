// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/system_state.hpp"
#include "dynamics/workspace.hpp"

namespace limber::dynamics {

/// Where the energy is. All [J] but the momenta.
struct EnergyBalance {
  double kinetic_rigid = 0.0;  ///< m v^2/2 + w' J w/2
  double kinetic_modal = 0.0;  ///< w' H etadot + etadot^2/2; `full`: the rest
  double elastic = 0.0;        ///< eta' diag(lambda) eta / 2; `full`: int W dV
  double coupler = 0.0;        ///< stored in couplers
  double dissipated = 0.0;     ///< since the run began
  double work = 0.0;  ///< of loads, gravity and drives since the run began
  Vector3 linear_momentum = Vector3::Zero();   ///< world [kg m/s]
  Vector3 angular_momentum = Vector3::Zero();  ///< about Wo [kg m^2/s]

  [[nodiscard]] double total() const {
    return kinetic_rigid + kinetic_modal + elastic + coupler;
  }
};

/// All but `dissipated` and `work`, which only a run can know.
[[nodiscard]] EnergyBalance calc_energy(const SystemModel& model,
                                        const SystemState& state);
/// The same in `terms` of make_terms(model), without allocation.
[[nodiscard]] EnergyBalance calc_energy(const SystemModel& model,
                                        const SystemState& state,
                                        SystemTerms& terms);

}  // namespace limber::dynamics
