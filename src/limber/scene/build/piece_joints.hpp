// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/joints/bushing.hpp"
#include "limber/scene/build/attachment_sites.hpp"
#include "limber/scene/build/body_plan.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::scene {

/// The bushing that holds two pieces together at a cut.
///
/// Equation   K of flexbody::calc_cut_stiffness(). Damping: rayleigh_stiffness
///            K, as in the material around it
/// @param F, M flexibilities in the axes of F [m/N, rad/(N m)]
[[nodiscard]] joints::Bushing make_cut_bushing(
    const Matrix6& F, const Matrix6& M, const dynamics::ModalDamping& damping);

/// Joins the pieces of every link at their cuts, by couplers called
/// "LINK.1/LINK.2".
void add_piece_joints(const Scene& scene, const BodyPlans& plans,
                      const AttachmentSites& sites,
                      dynamics::SystemBuilder& builder);

}  // namespace limber::scene
