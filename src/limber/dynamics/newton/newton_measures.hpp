// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/newton/motion_groups.hpp"

/// Lengths for the convergence tests of Newton's method in a time step:
/// mass-weighted within a body, so that rotations and modes count by the
/// displacement of its mass; the maximum over the bodies of each group of
/// MotionGroups. All take one value a group.
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
void measure_correction(const SystemModel& model, const MotionGroups& groups,
                        const VectorX& increments,
                        std::vector<CorrectionSize>& sizes);

/// Two corrections in succession: sums over a group of the squares of their
/// lengths, each times a body's mass, and of their product [kg m^2].
struct Reversal {
  double both = 0.0;
  double now = 0.0;
  double before = 0.0;

  /// Whether it takes the last one back, to within a tenth.
  [[nodiscard]] bool is_whole() const {
    return now > 0.0 && now + 2.0 * both + before <= 0.01 * now;
  }
  /// Whether the angle between them is more than 120 degrees.
  [[nodiscard]] bool is_backward() const;
};
/// @param now, before as increments of NewtonMatrix
void measure_reversal(const SystemModel& model, const MotionGroups& groups,
                      const VectorX& now, const VectorX& before,
                      std::vector<Reversal>& reversals);

/// Below these [m] corrections are round-off.
struct Roundoff {
  double rigid = 0.0;  ///< [m]
  double modal = 0.0;  ///< [m]
  double step = 0.0;   ///< of velocities, as translations in a step [m]
};
/// Of the coordinates themselves.
void measure_roundoff(const SystemModel& model, const MotionGroups& groups,
                      const SystemState& state, const VectorX& motion,
                      std::vector<Roundoff>& roundoffs);

/// Raises that of bodies in contact, in which rotations and small gaps are
/// differences of places on their surfaces.
void raise_roundoff_in_contact(const SystemModel& model,
                               const MotionGroups& groups,
                               const SystemTerms& terms,
                               std::vector<Roundoff>& roundoffs);

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
