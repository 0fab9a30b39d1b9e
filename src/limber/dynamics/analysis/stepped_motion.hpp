// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"
#include "limber/dynamics/integrators/alpha_parameters.hpp"

namespace limber::dynamics {

/// Linear motion as equal steps of generalized-alpha take it.
///
/// Equation   z = (p, v, y) of a LinearModel of LinearSystem, p' = s v,
///            v' = K p + D v - E' y + F u, y' = E v - y / tau;
///            p_1 = p_0 + s (h v_0 + h^2 (lag a_0 + beta a_1)),
///            v_1 = v_0 + h ((1 - gamma) a_0 + gamma a_1),
///            y_1 = k y_0 + g E (q_1 - q_0), p = s q,
///            (1 - am) a_1 + am a_0 = (1 - af) v'_1 + af v'_0;
///            where inputs jump, a and v' change by c x, (c - cv D - K s
///            + g E' E) x = F du, c and cv the coefficients of a step
/// Source     Chung and Hulbert, J. Appl. Mech. 60, 1993; GeneralizedAlpha
/// Limits     equal steps
class SteppedMotion {
 public:
  /// @param A of the model [1/s], stored by reference
  /// @param coordinates n, of p and of v
  /// @param step the longest [s]
  SteppedMotion(const MatrixX& A, Eigen::Index coordinates,
                const AlphaParameters& parameters, double step);

  /// Effect of the inputs on z, by columns: an input may have a slope, whose
  /// force is its column of `by_slope`.
  struct Inputs {
    MatrixX by_value;
    MatrixX by_slope;   ///< as many columns
    MatrixX by_steady;  ///< of further inputs, which are constant
  };

  /// Numbers of the vector's second part: a, v', and the inputs before a jump.
  [[nodiscard]] Eigen::Index memory_size(Eigen::Index inputs) const {
    return 2 * n_ + inputs;
  }
  /// Map of (z, memory, inputs, slopes, steady inputs) over a time in which
  /// inputs change by their slopes, after a jump at its begin.
  [[nodiscard]] MatrixX find_flow(const Inputs& inputs, double duration) const;

 private:
  struct Layout;
  [[nodiscard]] MatrixX find_jump(const Inputs& inputs, const Layout& at,
                                  double h) const;
  [[nodiscard]] MatrixX find_step(const Inputs& inputs, const Layout& at,
                                  double h) const;
  // (1 - am) / (1 - af) - h gamma D - h^2 beta (K s - E' g E)
  [[nodiscard]] MatrixX find_matrix(double h) const;
  // g, one a relaxation [-]
  [[nodiscard]] VectorX find_gains(double h) const;

  const MatrixX& A_;
  Eigen::Index n_;
  AlphaParameters p_;
  double step_;
};

}  // namespace limber::dynamics
