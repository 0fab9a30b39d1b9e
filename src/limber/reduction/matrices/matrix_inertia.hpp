// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/flexbody/modal/reduced_basis.hpp"
#include "limber/flexbody/model/reduced_body.hpp"
#include "limber/reduction/matrices/matrix_part.hpp"

/// Inertia shape integrals of a model given by matrices. Part of
/// limber_reduction.
namespace limber::flexbody {

/// How far the nodes' blocks of M are from the mass that moves in the modes.
struct BlockDefects {
  double motion = 0.0;   ///< of kinetic energy in rows without a node [-]
  double shape = 0.0;    ///< of S2 by blocks that differ by direction [-]
  double inertia = 0.0;  ///< MatrixPart::block_defect [-]

  [[nodiscard]] double largest() const;
};

/// Integrals and where they come from.
struct MatrixInertia {
  InertiaShapeIntegrals integrals;
  InertiaRecord record;
  InertialLevers levers;  ///< all zero if S1 is not known
};

/// By the second moments of M where the model has them. Else by the nodes'
/// blocks of M (calc_block_integrals) where M is that of a field.
/// A superelement, whose interior moves in rows without a node or was
/// condensed, is none: with recovery rows its mass is fitted to points that
/// move as these say, and without them J0 and P alone are known, and record.gap
/// states why.
///
/// Equation   sum_p m_p [X_p Phi_p]^T [X_p Phi_p] = [X Phi]^T M [X Phi], m_p >=
///            0, in the least square; S1_k = sum m_p x_p u_pk^T, S2_kl = sum
///            m_p u_pk u_pl^T. J0, P and X_r^T M Phi are those of M
/// Limits     fits with a residual below 0.02 are taken; of a body that rotates
///            nowhere (clamped) S1 and S2 do not matter
/// @param Phi rows x m, zero on rows that are held @param fields 6N x m
[[nodiscard]] MatrixInertia find_matrix_inertia(const MatrixPart& part,
                                                const ReducedBasis& basis,
                                                const MatrixX& Phi,
                                                const MatrixX& fields,
                                                bool is_clamped);

}  // namespace limber::flexbody
