// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

namespace limber::dynamics {

/// How far the points of a body's surface can move by its unknowns.
struct SurfaceReach {
  bool is_member = false;  ///< whether it has such points
  /// Of the undeformed points from the body frame's origin, at most [m]; of an
  /// unreduced body motion of its surface per displacement of a node [-].
  double extent = 0.0;
  VectorX modes;  ///< of modes and their products [kg^-1/2; kg^-1 m^-1]
};

}  // namespace limber::dynamics
