// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/newton/newton_measures.hpp"

/// Convergence criteria of Newton's method in a time step.
namespace limber::dynamics {

/// Smallest error required, relative to a step's motion [-].
inline constexpr double kLeastShare = 1e-12;

/// Largest error allowed for both kinds of motion [m]: a hundredth of the
/// step's own error, between 1e-12 and 1e-9 of its motion.
///
/// Equation   the correction of a prediction by linearly extrapolated
///            accelerations is c = beta h^2 e, e = h^2 a'' their error. Of the
///            second-order
///            A-stable schemes the trapezoidal rule has the smallest error in
///            velocity, h^3 a'' / 12 = h e / 12, and a correction x changes
///            the velocity by gamma x / (beta h): x = c / (12 gamma) changes
///            it by as much.
/// Source     errors from predictor and corrector: [@milne1926]; the
///            trapezoidal rule's error: [@dahlquist1963]
/// @param predictor_errors lengths of the first correction after such a
/// prediction [m]; zero for any other
/// @param gamma of Newmark's formula for the velocity [-]
/// @param motion length of the step's motion [m]
[[nodiscard]] CorrectionSize find_limit(const CorrectionSize& predictor_errors,
                                        double gamma, double motion);

/// Whether, for both kinds of motion, the error left after a correction is
/// within the limit, if corrections contract further as from the one before to
/// this one, or the correction is round-off.
[[nodiscard]] bool has_converged(const CorrectionSize& correction,
                                 const CorrectionSize& before,
                                 const CorrectionSize& limit,
                                 const Roundoff& roundoff);

/// Detects a cycle of Newton's method: where an edge of a mesh is pressed
/// inwards, the solution for one of its faces makes the other one nearest, and
/// corrections alternate between them.
class FaceCycle {
 public:
  /// @param corrections as in NewtonMatrix
  explicit FaceCycle(Eigen::Index corrections);

  /// @param is_first whether it is the first of a step, which reverts nothing
  /// @param touches whether a mesh does; if not, the call costs nothing
  void include(const VectorX& correction, bool is_first, bool touches);

  /// Whether the last correction reverted the one before it, to within a tenth,
  /// and is at most 1e-3 of the step's motion.
  /// @param size, motion [m]
  [[nodiscard]] bool ends(double size, double motion) const;

 private:
  VectorX last_;
  bool touched_ = false;
  bool goes_back_ = false;
};

}  // namespace limber::dynamics
