// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/fem/mesh/surface.hpp"
#include "limber/flexbody/modal/reduced_basis.hpp"
#include "limber/flexbody/model/contact_surface.hpp"
#include "limber/reduction/body_with_surface.hpp"
#include "limber/reduction/slices/surface_samples.hpp"

/// Flat surfaces as parts that move as one piece. Part of limber_reduction.
namespace limber::flexbody {

/// Divides a flat surface into rectangles, as few as its modes allow: until
/// sum_k <(u_k - fit)^2> / lambda_k <= kMostDeformation sum_k <u_k^2> /
/// lambda_k, with u_k the mode's displacement along the normal, or there are
/// eight. Of a surface that is not convex those that fill most are halved until
/// the hulls of what is in them are not half a percent larger than it, or there
/// are kMostParts.
///
/// Equation   fit: the least squares over the part's area; R = F^T
///            K^+ F, of uniform pressure on the part
/// Limits     none of a surface whose parts would fill 2 % more than its area
/// @param normal of the surface, unit, outward
/// @param basis on the free nodes; @param Phi its 3N x m rows of all nodes
/// @param center of mass, mesh frame [m]
/// @param depth of all parts [m]
[[nodiscard]] std::vector<ContactPart> make_contact_parts(
    const BodyWithSurface& body, const fem::Surface& surface,
    const Vector3& normal, const ReducedBasis& basis, const MatrixX& Phi,
    const Vector3& center, double depth);

}  // namespace limber::flexbody
