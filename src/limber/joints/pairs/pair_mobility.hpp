// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

namespace limber::joints {

/// Accelerations that unit loads on a pair's bodies cause at once, all that
/// joins them to others included: symmetric, each in its body's own axes, of Ao
/// and A's rotation, then of Bo and B's rotation; zero of the world
/// [1/kg; 1/(kg m); 1/(kg m^2)].
using PairMobility = Eigen::Matrix<double, 12, 12>;

}  // namespace limber::joints
