// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/joints/bushing.hpp"
#include "limber/scene/build/attachment_sites.hpp"
#include "limber/scene/build/body_plan.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::scene {

/// Stiffness of a cut relative to that of its two pieces, in every direction
/// [-].
inline constexpr double kCutStiffnessRatio = 10000.0;

/// The bushing that holds two pieces together at a cut.
///
/// Equation   K = kCutStiffnessRatio (C_F + C_M)^-1, with C the flexibility of
///            each piece at its side of the cut, 6 x 6: the cut adds at most
///            0.01 % to the flexibility of the pieces, in tension as in
///            bending. Damping: rayleigh_stiffness K, as of the material around
///            it
/// @param F, M flexibilities in the axes of F [m/N, rad/(N m)]
[[nodiscard]] joints::Bushing make_cut_bushing(
    const Matrix6& F, const Matrix6& M, const dynamics::ModalDamping& damping);

/// Joins the pieces of every link at their cuts, by couplers called
/// "LINK.1/LINK.2".
void add_piece_joints(const Scene& scene, const BodyPlans& plans,
                      const AttachmentSites& sites,
                      dynamics::SystemBuilder& builder);

}  // namespace limber::scene
