// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

namespace limber::dynamics {

/// A sampled law that is linear in its measurements.
///
/// Equation   x_(k+1) = F x_k + G (y_k, r_k, r'_k)
///            u_k     = H x_k + J (y_k, r_k, r'_k)
///            with measurements y, the reference r and its rate r'
struct LinearLaw {
  MatrixX F;  ///< n x n
  MatrixX G;  ///< n x (measurements + 2)
  MatrixX H;  ///< outputs x n
  MatrixX J;  ///< outputs x (measurements + 2)
};

}  // namespace limber::dynamics
