// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

namespace limber::contact {

/// Of a contact about two axes of its tangent plane: a plain value, part of the
/// state.
struct RollingSpring {
  double stiffness = 0.0;                            ///< [N m]
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();  ///< [N m]
};

/// Conditions under which a contact rolls.
struct RollingLoad {
  double force = 0.0;            ///< normal, damping included, >= 0 [N]
  double stiffness = 0.0;        ///< k of the elastic normal force > 0 [N/m]
  double inverse_inertia = 0.0;  ///< of both bodies >= 0 [1/(kg m^2)]
};

/// Of B relative to A, about the same axes.
struct RollingMotion {
  Eigen::Vector2d rotation =
      Eigen::Vector2d::Zero();                     ///< since the last commit
  Eigen::Vector2d rate = Eigen::Vector2d::Zero();  ///< [rad/s]
};

/// On B.
struct RollingResponse {
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();  ///< [N m]
  double energy = 0.0;                               ///< of the spring [J]
  double slip_work = 0.0;     ///< lost by rolling on and release, >= 0 [J]
  double damper_power = 0.0;  ///< >= 0 [W]
  Eigen::Matrix2d by_rotation = Eigen::Matrix2d::Zero();  ///< [N m]
  Eigen::Matrix2d by_rate = Eigen::Matrix2d::Zero();      ///< [N m s]
  Eigen::Vector2d by_force = Eigen::Vector2d::Zero();     ///< [m]
  RollingSpring next;                                     ///< what to commit
};

/// A moment against rolling, of which the normal force times an arm is the
/// largest: a spring that rolls on beyond it, and a damper of 0.3 of
/// the critical damping, together within it.
///
/// Equation   T* = T_0 min(1, k_r / k_r0) + k_r rotation, T = T* min(1, b f /
///            |T*|), moment = -T - c rate within b f; k_r = 3 k b^2, that of a
///            strip of springs 6 b wide, which b f tilts until one edge is free
/// Source     [@iwashita1998; @jiang2005]; damping [@ai2011]; return mapping
/// [@wriggers2006, ch. 5]
/// @param arm b >= 0 [m]
[[nodiscard]] RollingResponse resist_rolling(double arm,
                                             const RollingSpring& before,
                                             const RollingLoad& load,
                                             const RollingMotion& motion);

/// [J]
[[nodiscard]] double find_energy(const RollingSpring& spring);

}  // namespace limber::contact
