// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "limber/dynamics/equations/residual.hpp"

/// Lengths for the convergence tests of Newton's method in a time step:
/// mass-weighted within a body, so that rotations and modes count by the
/// displacement of its mass; the maximum over bodies.
namespace limber::dynamics {

/// Length of a correction [m], and of its two kinds separately. The precision
/// of modal coordinates does not depend on the distance from the world's
/// origin.
struct CorrectionSize {
  double value = 0.0;    ///< of both kinds [m]
  std::size_t body = 0;  ///< index of the body that moves most
  double rigid = 0.0;    ///< of frames, and of nodes of unreduced bodies [m]
  double modal = 0.0;    ///< [m]
};
/// @param increments as in NewtonMatrix
[[nodiscard]] CorrectionSize measure_correction(const SystemModel& model,
                                                const VectorX& increments);

/// A step's motion on the same scale [m].
[[nodiscard]] double measure_motion(const SystemModel& model,
                                    const Rates& motion);

/// Below these [m] corrections are round-off.
struct Roundoff {
  double rigid = 0.0;  ///< [m]
  double modal = 0.0;  ///< [m]
};
/// Of the coordinates themselves.
[[nodiscard]] Roundoff measure_roundoff(const SystemModel& model,
                                        const SystemState& state);

/// Effect of round-off of frames' motion on the laws' wrenches, as gaps of
/// NewtonMatrix, one per coupler, then one per transmission. Their solution is
/// the unavoidable effect of stiff couplers on the motion.
/// @param velocity per increment, of NewtonMatrix::Coefficients [1/s]
void find_roundoff_gaps(const SystemModel& model, const SystemTerms& terms,
                        double velocity, std::vector<Vector6>& gaps);

/// The same of pairs' forces, as a residual.
/// @param velocity as above
void calc_pair_roundoff(const SystemModel& model, const SystemState& state,
                        const SystemTerms& terms, double velocity,
                        VectorX& residual);

}  // namespace limber::dynamics
