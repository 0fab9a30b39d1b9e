// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/contact/law/hertz_law.hpp"

namespace limber::contact {

/// Of Hertz's impact, over its depth / speed [-].
inline constexpr double kHertzDuration = 2.9433;

/// Central impact of two free rigid bodies without damping.
struct ImpactEstimate {
  double duration = 0.0;    ///< T_c [s]
  double peak_force = 0.0;  ///< [N]
  double peak_depth = 0.0;  ///< [m]
};

/// Equation   V(f_p) = m v^2 / 2,  T_c = 2 m v int sin(x) / f(x) dx over
///            0 < x < pi/2, with V(f(x)) = V(f_p) sin(x)^2.
///            Of R = 0: d_p = (5 m v^2 / (4 k))^(2/5), T_c = 2.9433 d_p / v
///            = 3.2180 (m^2 / (k^2 v))^(1/5), with 2.9433 =
///            4/5 sqrt(pi) Gamma(2/5) / Gamma(9/10).
///            Of k infinite: T_c = pi sqrt(m R), at any speed.
///            Between, with T_H and T_R of these two:
///            sqrt(T_H^2 + T_R^2) <= T_c <= T_H + T_R.
/// Source     R = 0: [@johnson1985, ch. 11]
/// Limits     bodies that vibrate may separate sooner and come into contact
/// again. Damping
///            makes the impact longer (twice at restitution 0.1, 7.2 times at
///            0.01) and less deep, and the rising force higher (1.4 times at
///            0.1, 3.3 at 0.01; more where R dominates)
/// @param mass 1/m = 1/m_A + 1/m_B of the two bodies > 0 [kg]
/// @param speed v > 0 [m/s]
/// @throws ContractError for values outside their range.
[[nodiscard]] ImpactEstimate estimate_impact(const HertzLaw& law, double mass,
                                             double speed);

}  // namespace limber::contact
