// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/terms/kinematics.hpp"

/// Jacobian of an attachment's frame by its body's unknowns, ordered as in
/// dynamics/newton/newton_matrix.hpp: rows translation over rotation, expressed
/// in frame A of `R_AW` or `R_AH`.
namespace limber::dynamics {

/// @param G 6 x (6 + m)
void calc_modal_jacobian(const Attachment& attachment,
                         const AttachmentMotion& motion, const Matrix3& R_AW,
                         Matrix6X& G);

/// For a frame on weighted nodes.
///
/// Equation   d theta = spread sum_i R y_i x du_i
///                    + line_spread sum_i lever_i du_i,
///            d p = sum_i w_i du_i + d theta x arm
/// @param G 6 x 3N; columns of nodes that are not in the frame are zeroed
void calc_nodal_jacobian(const NodalFrame& frame,
                         const NodalFrameMotion& motion, const Matrix3& R_AH,
                         Matrix6X& G);

}  // namespace limber::dynamics
