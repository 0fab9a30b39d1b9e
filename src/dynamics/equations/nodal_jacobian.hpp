// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/kinematics.hpp"

/// How an attachment's frame moves per unit of its body's unknowns, as
/// dynamics/newton_matrix.hpp orders them: rows translation over rotation, in
/// the axes that `R_AW` or `R_AH` turns into.
namespace limber::dynamics {

/// @param G 6 x (6 + m)
void calc_modal_jacobian(const Attachment& attachment,
                         const AttachmentMotion& motion, const Matrix3& R_AW,
                         Matrix6X& G);

/// Of weighted nodes.
///
/// Equation   d theta = spread sum_i R y_i x du_i
///                    + line_spread sum_i lever_i du_i,
///            d p = sum_i w_i du_i + d theta x arm
/// @param G 6 x 3N; columns of nodes that are not in the frame are zeroed
void calc_nodal_jacobian(const NodalFrame& frame,
                         const NodalFrameMotion& motion, const Matrix3& R_AH,
                         Matrix6X& G);

}  // namespace limber::dynamics
