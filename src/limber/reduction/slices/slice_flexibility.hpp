// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/fem/solid/material.hpp"
#include "limber/reduction/slices/slice_motion.hpp"
#include "limber/reduction/slices/surface_division.hpp"

/// Local flexibility of a slice beyond its motion as one piece. Part of
/// limber_reduction.
namespace limber::flexbody {

/// Of the residual flexibility, counted twice, what exceeds the compliance 1 /
/// (2 E' a) of the slice's own half space along each axis; pi a^2 is the area
/// of the faces on the larger side, E' = E / (1 - nu^2).
/// @param residual of the slice's loads, 3 x 3 [m/N] @param axes of the boxes
[[nodiscard]] Matrix3 find_excess(const SurfaceSlice& slice,
                                  const Matrix3& residual, const Matrix3& axes,
                                  const fem::ElasticMaterial& material);

/// What the modes deform the slice: a touch presses one place of it, but its
/// motion is the mean of all. At one place this can be off by several times
/// its value, for the modes' bending has a sign there.
///
/// Equation   sum_k <d_k d_k'> / lambda_k, d_k = u_k - fit at eight stations
///            along its longest side, each a SliceMotion, weighed along each
///            axis e by int (n . e)^2 dA
/// @param whole its motion as one piece, and that of each mode, 6 x m
/// @param lambda [rad^2/s^2]
/// @param Phi 3N x m rows of all nodes, its first columns those of lambda
/// @returns 3 x 3, positive semidefinite [m/N]
[[nodiscard]] Matrix3 find_own_flexibility(
    const SurfaceSlice& slice, const SliceMotion& whole, const MatrixX& motion,
    const Matrix3& axes, const VectorX& lambda, const MatrixX& Phi);

}  // namespace limber::flexbody
