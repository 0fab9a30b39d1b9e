// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/fem/mesh/surface.hpp"

/// Sample points that represent a surface's area. Part of limber_reduction.
namespace limber::flexbody {

/// Fraction of a surface's modal flexibility along its normals that the own
/// deformation of its parts may have [-].
inline constexpr double kMostDeformation = 1e-4;

/// A point of the surface that represents the area around it.
struct SurfaceSample {
  const fem::SurfaceFace* face = nullptr;
  VectorX shape;  ///< values of the functions of the face's nodes [-]
  Vector3 x = Vector3::Zero();       ///< mesh frame [m]
  Vector3 normal = Vector3::Zero();  ///< unit, outward [-]
  double area = 0.0;                 ///< [m^2]
};

/// By rules of second degree on 256 cells of each face of a surface of up to 64
/// faces, on 16 of others. @param surface of `mesh`, which outlives the samples
[[nodiscard]] std::vector<SurfaceSample> sample_surface(
    const fem::Mesh& mesh, const fem::Surface& surface);

/// The modes' displacements along the normal. @param Phi 3N x m rows of all
/// nodes @returns `modes` values, of the first columns
[[nodiscard]] VectorX find_heights(const SurfaceSample& s, const MatrixX& Phi,
                                   Eigen::Index modes, const Vector3& normal);

}  // namespace limber::flexbody
