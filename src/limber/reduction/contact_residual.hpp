// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/flexbody/modal/reduced_basis.hpp"
#include "limber/reduction/body_with_surface.hpp"
#include "limber/reduction/contact_patches.hpp"

/// Residual flexibility of a basis. Part of limber_reduction.
namespace limber::flexbody {

/// Displacement of each patch under a unit load on it, minus that in the basis
/// [m/N]; for a free body the elastic part, under inertia relief.
///
/// Equation   R = f^T K^+ f - f^T Phi Lambda^-1 Phi^T f = F^T K^+ F >= 0,
///            f = w (x) n, F = f - K Phi Lambda^-1 Phi^T f; with A = K - s M,
///            X = A^-1 F: F^T K^+ F = F^T X - s X^T M X + O((s / lambda)^2)
/// Source     [@macneal1971] for the residual; the load is projected, because
/// the
///            difference of two large flexibilities loses its digits
/// @param basis on the free nodes; @param what for progress
[[nodiscard]] VectorX calc_residual_flexibility(
    const BodyWithSurface& body, const ReducedBasis& basis,
    const std::vector<ContactPatch>& patches, const std::string& what = {},
    const Progress& progress = {});

/// The same for all pairs of a few loads, symmetric and positive semidefinite:
/// R_ij = F_i^T K^+ F_j. @param loads 3N x k on all nodes of the mesh [-]
[[nodiscard]] MatrixX calc_residual_matrix(const BodyWithSurface& body,
                                           const ReducedBasis& basis,
                                           const MatrixX& loads);

/// Mean displacement of a half-space under Hertz's pressure of radius b,
/// weighted by this pressure: the part of Hertz's approach due to the local
/// deformation [m/N].
///
/// Equation   3 / (5 E' b), E' = E / (1 - nu^2)
/// Source     u = pi p_0 (2 b^2 - r^2) / (4 E' b) [@johnson1985, sec. 3.4],
///            of which the mean of r^2 under the pressure is 2 b^2 / 5
[[nodiscard]] double calc_hertz_fraction(const fem::ElasticMaterial& material,
                                         double radius);

}  // namespace limber::flexbody
