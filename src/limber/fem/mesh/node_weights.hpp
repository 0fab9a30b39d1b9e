// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "limber/fem/mesh/mesh.hpp"

namespace limber::fem {

/// Nodes with their weights in a distributed load or an average.
///
/// Equation   w_n = int N_n dA / A,  p = sum w_n x_n,
///            y_n = int N_n (x - p) dA / A  over a region; w_n (x_n - p) of
///            single nodes. The means of a field u over the region are
///            sum w_n u_n and those of (x - p) x u are sum y_n x u_n.
/// Limits     w_n is zero at the corners of straight second-order triangles
///            and negative, -1/12, at those of quadrangles of eight nodes: the
///            fraction of a load spread evenly. y_n is then not w_n (x_n - p).
struct WeightedNodes {
  std::vector<int> nodes;  ///< sorted node indices
  VectorX weights;         ///< w, sum to one [-]
  Matrix3X moments;        ///< y, sum to zero [m]
};

/// Fractions of a load spread evenly over a physical group: a surface, a curve
/// or a volume; equal over points.
[[nodiscard]] WeightedNodes weigh_group(const Mesh& mesh,
                                        const PhysicalGroup& group);

/// Every node with the same fraction.
[[nodiscard]] WeightedNodes weigh_equally(const Mesh& mesh,
                                          std::vector<int> nodes);

/// Boundary nodes near a region.
struct NearNodes {
  std::vector<int> nodes;  ///< sorted node indices
  double nearest = 0.0;    ///< distance of the nearest of all nodes [m]
};

/// Boundary nodes whose `distance` [m] from a region is `tolerance` or less.
[[nodiscard]] NearNodes find_boundary_nodes(
    const Mesh& mesh, const std::function<double(const Vector3&)>& distance,
    double tolerance);

/// Fractions of a load spread evenly over the boundary faces that lie wholly in
/// `nodes`; equal fractions if there is no such face.
[[nodiscard]] WeightedNodes weigh_boundary(const Mesh& mesh,
                                           const std::vector<int>& nodes);

/// Weights of a ragged cut through a body, by which an even pull and bending
/// across it act as in the whole body, whose stress has no other component.
///
/// Equation   a = int n dA / |int n dA|;  w_n = int N_n (n . a) dA / A,
///            y_n = int N_n (I - a a^T)(x - p) (n . a) dA / A,
///            A = int n . a dA
/// Source     traction sigma n of a stress sigma a a^T, even or linear across
/// @param faces of the elements on one side, in one part
[[nodiscard]] WeightedNodes weigh_cut(const Mesh& mesh,
                                      const std::vector<BoundaryFace>& faces);

/// Node with this Gmsh tag. @throws InputError.
[[nodiscard]] int find_tagged_node(const Mesh& mesh, std::size_t tag);

/// Node nearest to a point [m].
[[nodiscard]] int find_nearest_node(const Mesh& mesh, const Vector3& point);

}  // namespace limber::fem
