// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "limber/fem/mesh/surface.hpp"
#include "limber/reduction/slices/surface_samples.hpp"

/// Surfaces as slices that move as one piece. Part of
/// limber_reduction.
namespace limber::flexbody {

/// The part of a surface within a box.
struct SurfaceSlice {
  std::vector<const SurfaceSample*> samples;
  Matrix3X normals;  ///< 3 x k of the planes that part it from others, outward
  VectorX heights;   ///< k: n . x on them [m]
};

struct SurfaceDivision {
  Matrix3 axes = Matrix3::Identity();  ///< of the boxes
  std::vector<SurfaceSlice> slices;
};

/// Halves a box about the surface, then the boxes that deform most, across
/// their longest side, as often as its modes need: until
/// sum_k <(n . (u_k - fit))^2> / lambda_k <= kMostDeformation sum_k <(n .
/// u_k)^2> / lambda_k with SliceMotion as fit, or there are `most` boxes. Those
/// whose own mean flexibility, <...> / lambda_k, is at most four times what the
/// surface gives way locally, 1 / (2 E' a) with pi a^2 a sixth of their area,
/// are not halved: a compact body stays in one piece.
/// The axes are those of the second moments of the surface's area.
/// @param samples outlive it @param lambda [rad^2/s^2]
/// @param Phi 3N x m rows of all nodes, its first columns those of lambda
/// @param modulus E' = E / (1 - nu^2) [Pa]
[[nodiscard]] SurfaceDivision divide_surface(
    const std::vector<SurfaceSample>& samples, const VectorX& lambda,
    const MatrixX& Phi, double modulus, std::size_t most);

}  // namespace limber::flexbody
