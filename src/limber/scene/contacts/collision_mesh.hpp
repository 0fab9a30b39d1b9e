// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/pose.hpp"
#include "limber/flexbody/model/contact_surface.hpp"
#include "limber/scene/contacts/triangle_file.hpp"
#include "limber/scene/robot/geometry.hpp"

namespace limber::scene {

/// A closed surface of straight triangles without modes and residual
/// flexibility. Corners that differ by less than 1e-6 of its size are merged.
/// The radius of a node's patch is the mean length of the edges there, at most
/// half of the smallest side of the box around the surface.
/// @param name in messages
/// @throws InputError, with the place, for a triangle without area, and for a
/// surface that is open, is inside out, joins more than two triangles in
/// one edge or intersects itself.
[[nodiscard]] flexbody::ContactSurface join_triangles(
    const std::vector<Triangle>& triangles, const std::string& name);

/// The file of a mesh as a surface of a body. @param X_BS of the mesh's frame
/// @throws InputError as read_triangles and join_triangles.
[[nodiscard]] flexbody::ContactSurface read_collision_mesh(
    const MeshGeometry& mesh, const Pose& X_BS);

}  // namespace limber::scene
