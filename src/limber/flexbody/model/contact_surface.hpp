// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "limber/common/types.hpp"

namespace limber::flexbody {

/// Largest number of parts of a surface.
inline constexpr std::size_t kMostParts = 32;

/// A convex part of a flat surface that moves as one piece.
///
/// Equation   motion of its centre and rotation motion_B eta, without a part of
///            the highest modes: s_k = sqrt(1 - u^4), u = omega_k (N + 1/2) /
///            (N omega_N), N modes that move it along the normal; R = R_res +
///            sum (1 - s_k^2) (n . phi_k)^2 / lambda_k
/// Source     docs/theory/contact_surfaces.md
struct ContactPart {
  Vector3 normal_B = Vector3::Zero();  ///< unit, outward [-]
  /// Of its area, undeformed, relative to the c.m. [m]
  Vector3 centre_B = Vector3::Zero();
  Matrix3X corners_B;  ///< 3 x k, right-hand about the normal [m]
  /// Edges, from that corner to the next, on the rim of the surface; at the
  /// others the next part begins.
  std::vector<std::size_t> rim;
  MatrixX motion_B;    ///< 6 x m [kg^-1/2, kg^-1/2 / m]
  double depth = 0.0;  ///< of material under it [m]
  /// R_res along the normal under uniform pressure, of all modes [m/N]
  double residual = 0.0;
  double flexibility = 0.0;  ///< R, of what motion_B lacks [m/N]
};

/// Largest number of slices of a surface.
inline constexpr std::size_t kMostSlices = 8;

/// A piece of a surface that is not flat, which moves as one: what lies between
/// planes.
///
/// Equation   motion of its centre and rotation motion_B eta, without a part of
///            the highest modes, as a ContactPart's; u = motion_B eta + R f
///            for a force f spread over its faces
/// Source     docs/theory/contact_surfaces.md
struct ContactSlice {
  Matrix3X normals_B;  ///< 3 x k of the planes, away from it, unit [-]
  VectorX heights;     ///< k: n . x on them, from the c.m. [m]
  /// Of its area, undeformed, relative to the c.m. [m]
  Vector3 centre_B = Vector3::Zero();
  MatrixX motion_B;  ///< 6 x m [kg^-1/2, kg^-1/2 / m]
  /// R, of what motion_B lacks, positive semidefinite [m/N]
  Matrix3 flexibility_B = Matrix3::Zero();
  /// The fraction of R by which the modes deform the slice itself [m/N]
  Matrix3 own_B = Matrix3::Zero();
};

/// The part of a body's surface that may be in contact with others: its nodes
/// with the smoothed motion of a patch around each, and the residual
/// flexibility of the basis there.
///
/// Equation   u_p = n . Phi_B(p) eta + R_p f,  f a normal force on the patch
///            under Hertz's pressure of radius b: w^T of the displacements,
///            sum w = 1
/// Source     docs/theory/contact_surfaces.md
/// Limits     The patch and its pressure do not change with the force. No
///            residual flexibility in tangential directions and between
///            patches.
struct ContactSurface {
  std::string name;  ///< the group, or "skin" for the whole surface
  /// n Gmsh node tags; 0 where elements interpolate the middle of an edge, for
  /// which they have no node.
  std::vector<std::size_t> tags;
  Matrix3X x_B;   ///< 3 x n undeformed, relative to the c.m. [m]
  MatrixX Phi_B;  ///< 3n x m: w^T Phi, mean of the modes over the patch around
                  ///< each node [kg^-1/2]
  /// n: R_p of a unit normal force on the patch without Hertz's own fraction
  /// [m/N]. Negative where the residual flexibility is smaller than that share.
  /// Interpolate it linearly between the corners of a face.
  VectorX residual;
  VectorX patch_radius;  ///< n: b [m]
  /// Outward (right-hand) indices of nodes: the corners 0, 1, 2, then the
  /// middle nodes of the edges 01, 12, 20; -1, -1, -1 of a straight face.
  /// Quadrilateral faces are split into triangles.
  std::vector<std::array<int, 6>> faces;
  std::vector<ContactPart> parts;  ///< none unless it is flat
  /// None of a flat surface.
  std::vector<ContactSlice> slices;
  double youngs_modulus = 0.0;  ///< of the material under the surface [Pa]
  double poisson_ratio = 0.0;   ///< of the same [-]
};

}  // namespace limber::flexbody
