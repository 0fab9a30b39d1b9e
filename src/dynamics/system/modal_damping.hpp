// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace limber::dynamics {

/// Damping of a flexible body's modes: ratio_k omega_k 2 plus Rayleigh
/// alpha + beta omega_k^2.
struct ModalDamping {
  double rayleigh_mass = 0.0;       ///< alpha >= 0 [1/s]
  double rayleigh_stiffness = 0.0;  ///< beta >= 0 [s]
  std::vector<double> ratios;       ///< >= 0 per mode [-]; one value: all
};

}  // namespace limber::dynamics
