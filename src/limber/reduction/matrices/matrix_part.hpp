// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "limber/common/progress.hpp"
#include "limber/flexbody/model/recipe.hpp"
#include "limber/reduction/matrices/block_inertia.hpp"
#include "limber/reduction/matrices/free_system.hpp"

/// Part of limber_reduction.
namespace limber::flexbody {

/// A model by its matrices, checked, before any recipe. Immutable.
struct MatrixPart {
  MatrixSystem system;
  MatrixX X;  ///< rigid motions about the centre of mass, rows x 6
  RigidInertia inertia;
  MassBlocks blocks;
  double shift = 0.0;         ///< of the model without clamps [rad^2/s^2]
  double block_defect = 0.0;  ///< by calc_block_defect [-]
};

/// Checks that the matrices are those of a free structure at rest, in the
/// stated units, and reports in system.notices what is only questionable:
///
/// - mass: within 1 % of `mass`;
/// - rho = x^T K x / (x^T M x lambda_1) of the six rigid motions: silent below
///   1e-6, projected with a notice below 1e-2;
/// - no motion without stiffness besides;
/// - M positive semidefinite, X^T M X that of a rigid body, its blocks those of
///   a field (calc_block_defect): silent below 2e-3;
/// - digits of K: a notice where their rounding changes lambda_1 by 1e-4.
///
/// @param mass of the whole model, as stated [kg] @param unit as
/// make_matrix_system
/// @throws InputError naming the file, the motion, the nodes
[[nodiscard]] std::shared_ptr<const MatrixPart> make_matrix_part(
    fem::MatrixModel model, double mass, double unit,
    const Progress& progress = {});

}  // namespace limber::flexbody
