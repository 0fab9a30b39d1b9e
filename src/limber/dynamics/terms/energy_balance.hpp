// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

namespace limber::dynamics {

/// Energies and momenta of a system.
struct EnergyBalance {
  double kinetic_rigid = 0.0;  ///< m v^2/2 + w' J w/2 [J]
  /// w' H etadot + etadot^2/2; `full`: the rest [J].
  double kinetic_modal = 0.0;
  /// Of modes, eta' diag(lambda) eta / 2 if linear; `full`: int W dV [J].
  double elastic = 0.0;
  double coupler = 0.0;     ///< stored in couplers and pairs [J]
  double dissipated = 0.0;  ///< since the run began [J]
  /// Of loads, gravity and drives since the run began [J].
  double work = 0.0;
  Vector3 linear_momentum = Vector3::Zero();   ///< world [kg m/s]
  Vector3 angular_momentum = Vector3::Zero();  ///< about Wo [kg m^2/s]

  [[nodiscard]] double total() const {
    return kinetic_rigid + kinetic_modal + elastic + coupler;
  }
};

}  // namespace limber::dynamics
