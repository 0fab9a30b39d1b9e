// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "dynamics/residual.hpp"

/// Lengths by which Newton's method in a time step judges its corrections:
/// mass-weighted within a body, so that rotations and modes count by how far
/// they move its mass; the largest body counts.
namespace limber::dynamics {

/// Length of a correction [m], and of its two kinds apart. Modal coordinates
/// have digits of their own, however far from the world's origin a body is.
struct CorrectionSize {
  double value = 0.0;    ///< of both kinds
  std::size_t body = 0;  ///< that it moves most
  double rigid = 0.0;    ///< of frames, and of nodes of unreduced bodies
  double modal = 0.0;
};
/// @param increments as NewtonMatrix has them
[[nodiscard]] CorrectionSize measure_correction(const SystemModel& model,
                                                const VectorX& increments);

/// A step's motion on the same scale [m].
[[nodiscard]] double measure_motion(const SystemModel& model,
                                    const Rates& motion);

/// Below these [m] corrections are made of round-off alone.
struct Roundoff {
  double rigid = 0.0;
  double modal = 0.0;
};
/// Of the coordinates themselves.
[[nodiscard]] Roundoff measure_roundoff(const SystemModel& model,
                                        const SystemState& state);

/// What round-off of frames' motion may make of the laws' wrenches, as the gaps
/// of NewtonMatrix, one a coupler, then one a transmission. Solved for, they
/// are what stiff couplers cannot help doing to the motion.
/// @param velocity per increment, of NewtonMatrix::Coefficients [1/s]
void find_roundoff_gaps(const SystemModel& model, const SystemTerms& terms,
                        double velocity, std::vector<Vector6>& gaps);

}  // namespace limber::dynamics
