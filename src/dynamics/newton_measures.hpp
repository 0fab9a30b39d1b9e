// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "dynamics/residual.hpp"

/// Lengths by which Newton's method in a time step judges its corrections:
/// mass-weighted within a body, so that rotations and modes count by how far
/// they move its mass; the largest body counts.
namespace limber::dynamics {

/// Length of a correction.
struct CorrectionSize {
  double value = 0.0;    ///< [m]
  std::size_t body = 0;  ///< that it moves most
};
/// @param increments as NewtonMatrix has them
[[nodiscard]] CorrectionSize measure_correction(const SystemModel& model,
                                                const VectorX& increments);

/// A step's motion on the same scale [m].
[[nodiscard]] double measure_motion(const SystemModel& model,
                                    const Rates& motion);

/// Below this [m] corrections are made of round-off alone.
[[nodiscard]] double measure_roundoff(const SystemModel& model,
                                      const SystemState& state);

}  // namespace limber::dynamics
