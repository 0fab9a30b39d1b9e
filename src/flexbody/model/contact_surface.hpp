// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "limber/common/types.hpp"

namespace limber::flexbody {

/// The part of a body's surface that may touch others: nodes with the smoothed
/// motion of a patch around each, and the flexibility that the basis leaves
/// out there.
struct ContactSurface {
  std::string name;  ///< the group, or "skin" for the whole surface
  std::vector<std::size_t> tags;  ///< n node tags
  Matrix3X x_B;   ///< 3 x n undeformed, body frame, from the c.m. [m]
  MatrixX Phi_B;  ///< 3n x m: mean of the modes over the patch around each
                  ///< node, w^T Phi [kg^-1/2]
  /// n, displacement of each patch under a unit normal force on it that the
  /// modes leave out, Hertz's own share taken away, >= 0; linear between the
  /// corners of a face [m/N].
  VectorX residual;
  VectorX patch_radius;  ///< n [m]
  /// Right-handed about the outward normal, rows of nodes: corners 0, 1, 2,
  /// then the middle nodes of edges 01, 12, 20, which are -1 on straight
  /// (first-order) faces. Quadrilaterals are split into triangles.
  std::vector<std::array<int, 6>> faces;
  double youngs_modulus = 0.0;  ///< of the material under the surface [Pa]
  double poisson_ratio = 0.0;   ///< [-]
};

}  // namespace limber::flexbody
