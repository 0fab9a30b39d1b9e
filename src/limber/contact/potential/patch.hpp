// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

namespace limber::contact {

/// Contact of two solids by one potential, world axes; motions (u, theta)
/// and wrenches (force, moment) about the centre of pressure.
struct Patch {
  bool touches = false;
  double energy = 0.0;  ///< W [J]
  /// The part of W in flexibility in series with the surfaces [J].
  double series_energy = 0.0;
  double series_depth = 0.0;           ///< the part of `depth` in it [m]
  Vector3 centre_W = Vector3::Zero();  ///< of pressure [m]
  /// dW by a motion of B against A: minus the elastic wrench on B [N, N m].
  Vector6 gradient_W = Vector6::Zero();
  /// Its derivative, symmetric [N/m, N; N, N m].
  Matrix6 hessian_W = Matrix6::Zero();
  Matrix3 spread_W = Matrix3::Zero();  ///< second moments of pressure / N [m^2]
  double depth = 0.0;                  ///< largest [m]
  double exponent = 1.0;  ///< of the load by depth; of all but points 1 [-]
  /// What of each body's rotation moves its surface: nothing of a ball's,
  /// nothing about a round body's axis.
  Matrix3 turns_A_W = Matrix3::Identity();
  Matrix3 turns_B_W = Matrix3::Identity();

  /// From A to B, unit [-].
  [[nodiscard]] Vector3 normal_W() const {
    return -gradient_W.head<3>().normalized();
  }
  /// N, elastic [N].
  [[nodiscard]] double load() const { return gradient_W.head<3>().norm(); }
};

}  // namespace limber::contact
