// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "limber/fem/mesh/face_shape.hpp"
#include "limber/fem/mesh/mesh.hpp"

namespace limber::fem {

/// A node of a Surface.
struct SurfacePoint {
  Vector3 x = Vector3::Zero();  ///< mesh frame [m]
  int node = -1;                ///< index into Mesh::x; -1: interpolated
  /// Of the middle of an edge: the points at its ends; -1, -1 of a corner.
  std::array<int, 2> ends = {-1, -1};

  [[nodiscard]] bool is_corner() const { return ends[0] < 0; }
};

/// A face of a solid element.
struct SurfaceFace {
  std::size_t shape = 0;    ///< index into Surface::shapes
  std::vector<int> nodes;   ///< indices into Mesh::x, corners first
  std::vector<int> points;  ///< indices into Surface::points, corners first
};

/// A part of a body's surface as straight or six-node triangles.
///
/// Equation   a middle of an edge is the node there or, if the element has
///            none, the element's own interpolation: between the corners of a
///            face with eight nodes, and on edges of third-order elements
struct Surface {
  std::vector<FaceShape> shapes;
  std::vector<SurfaceFace> faces;
  std::vector<SurfacePoint> points;  ///< corners first, in the mesh's order
  /// Indices of points: corners, outward, and middles of edges 01, 12, 20; -1
  /// of first-order faces. A quadrilateral is two triangles.
  std::vector<std::array<int, 6>> triangles;
};

[[nodiscard]] Surface make_surface(const Mesh& mesh,
                                   const std::vector<BoundaryFace>& faces);

/// Boundary faces that belong to a physical group of dimension 2.
[[nodiscard]] std::vector<BoundaryFace> find_group_faces(
    const Mesh& mesh, const PhysicalGroup& group);

}  // namespace limber::fem
