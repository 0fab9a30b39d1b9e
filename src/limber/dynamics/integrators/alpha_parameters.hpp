// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "limber/dynamics/integrators/integrator.hpp"

namespace limber::dynamics {

/// Parameters of generalized-alpha [-]; by default those of implicit Euler.
struct AlphaParameters {
  double am = 0.0;     ///< alpha_m [-]
  double af = 0.0;     ///< alpha_f [-]
  double gamma = 1.0;  ///< [-]
  double beta = 1.0;   ///< [-]
  double lag = 0.0;    ///< factor of h^2 a_n in a step's motion [-]
};

/// Second order and least low-frequency damping for a given spectral radius at
/// infinite frequency.
/// @param rho_inf in [0, 1] [-]
/// Source     Chung and Hulbert, J. Appl. Mech. 60, 1993, eqs. 17, 20, 25
[[nodiscard]] inline AlphaParameters find_alpha_parameters(double rho_inf) {
  AlphaParameters p;
  p.am = (2.0 * rho_inf - 1.0) / (rho_inf + 1.0);
  p.af = rho_inf / (rho_inf + 1.0);
  p.gamma = 0.5 + p.af - p.am;
  p.beta = 0.25 * (0.5 + p.gamma) * (0.5 + p.gamma);
  p.lag = 0.5 - p.beta;
  return p;
}

/// The same with the treatment of motion that steps do not resolve: damped by a
/// spectral radius of at most 1/2.
[[nodiscard]] inline AlphaParameters find_alpha_parameters(
    double rho_inf, UnresolvedMotion motion) {
  if (motion == UnresolvedMotion::ended) return {};
  const bool calms = motion == UnresolvedMotion::calmed;
  return find_alpha_parameters(calms ? std::min(rho_inf, 0.5) : rho_inf);
}

}  // namespace limber::dynamics
