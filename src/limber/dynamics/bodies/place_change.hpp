// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/terms/system_terms.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"

/// Derivatives of the places of pairs by a body's unknowns.
namespace limber::dynamics {

/// Where Newton's matrix is differentiated.
struct TangentPoint {
  const SystemState& state;
  const SystemTerms& terms;
  const VectorX& motion;  ///< of the step, of all unknowns
  double velocity = 0.0;  ///< derivative of velocity by increments [1/s]
};

/// Change of a pair's place on a body by increments.
struct PlaceChange {
  Vector3 arm_B = Vector3::Zero();  ///< body frame [m]
  Vector3 p = Vector3::Zero();      ///< world frame [m]
  Vector3 v = Vector3::Zero();      ///< world frame [m/s]
};

/// A force at a pair's place on a body and how it changes.
struct PlaceForce {
  Vector3 arm_B;    ///< body frame [m]
  Vector3 d_arm_B;  ///< its change [m]
  Vector3 force;    ///< world frame [N]
  Vector3 d_force;  ///< its change [N]
};

}  // namespace limber::dynamics
