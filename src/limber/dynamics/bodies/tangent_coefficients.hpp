// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

namespace limber::dynamics {

/// Derivatives of acceleration and velocity at a step's end per increment.
struct TangentCoefficients {
  double acceleration = 0.0;  ///< [1/s^2]
  double velocity = 0.0;      ///< [1/s]
  /// Of all modes, what numerical damping adds to the diagonal of those whose
  /// elasticity is diagonal; null: nothing [1/s^2].
  const VectorX* calming = nullptr;
};

}  // namespace limber::dynamics
