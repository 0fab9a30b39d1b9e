// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/fem/matrices/file_set.hpp"

/// Second moments of a model's mass: what its mass matrix is the trace of.
///
/// Equation   S_ab,ij = int N_ai N_bj dm, u_a = sum_i N_ai q_i; M = S_xx + S_yy
///            + S_zz
namespace limber::fem {

/// Moves the set's second moments to the model.
/// @throws InputError if some are missing, have another size than the mass, or
/// do not sum to it
void take_second_moments(FileSet& set, MatrixModel& model);

}  // namespace limber::fem
