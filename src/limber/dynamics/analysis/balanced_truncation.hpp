// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/analysis/linear_model.hpp"

namespace limber::dynamics {

/// A linear model with fewer states, and the error of the reduction.
struct TruncatedModel {
  LinearModel model;
  /// Hankel singular values, decaying motion, descending [output's / input's].
  VectorX hankel;
  /// Number of states of motion that does not decay: free, undamped and
  /// unstable. They are the first ones of the model, all kept.
  Eigen::Index kept = 0;
  /// Upper bound of the error in gain from inputs to outputs at any frequency,
  /// in the matrix 2-norm [output's / input's].
  double bound = 0.0;
};

/// Balanced truncation of decaying motion; all other motion, whose Hankel
/// singular values are infinite, is separated first and kept.
///
/// Equation   (A, B, C) = (A_k, B_k, C_k) + (A_s, B_s, C_s) by invariant
///            subspaces; A_s P + P A_s' + B_s B_s' = 0,
///            A_s' R + R A_s + C_s' C_s = 0, P = X X', R = Y Y',
///            Y' X = U Sigma V': z_s = X V_1 Sigma_1^-1/2 z_1;
///            bound = 2 (sum of the values left out)
/// Source     square-root method: Laub et al., IEEE Trans. Automat. Control 32,
///            1987 [@laub1987]; factors X, Y: Hammarling, IMA J. Numer. Anal.
///            2, 1982 [@hammarling1982]; bound: Glover, Int. J. Control 39,
///            1984 [@glover1984]
/// Limits     decaying: damping ratio above 1e-9, and faster than the
///            round-off of free motion. Values and bound depend on the units
///            of inputs and outputs, which have equal weights. D is that of
///            the model, and so exact at high frequencies; the static gain is
///            not exact
/// @param states number of states of the result, those kept included
/// @throws InputError for fewer states than must remain, or more than there
/// are; a model without inputs or outputs.
[[nodiscard]] TruncatedModel truncate_balanced(const LinearModel& model,
                                               Eigen::Index states);

}  // namespace limber::dynamics
