// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/flexbody/modal/maxwell_elements.hpp"

namespace limber::dynamics {

/// Damping of a flexible body: that of its material, and dampers of its modes,
/// which are those of the body as its reduction holds it: ratio_k omega_k 2
/// plus Rayleigh alpha + beta omega_k^2.
struct ModalDamping {
  double rayleigh_mass = 0.0;              ///< alpha >= 0 [1/s]
  double rayleigh_stiffness = 0.0;         ///< beta >= 0 [s]
  std::vector<double> ratios = {};         ///< >= 0 [-]; one value: all modes
  flexbody::MaxwellElements maxwell = {};  ///< none: an elastic material
};

}  // namespace limber::dynamics
