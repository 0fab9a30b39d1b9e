// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "limber/fem/mesh/mesh.hpp"

namespace limber::fem {

/// Nodes with their weights in a distributed load or an average.
struct WeightedNodes {
  std::vector<int> nodes;  ///< sorted node indices
  VectorX weights;         ///< sum to one [-]
};

/// Shares of a load spread evenly over a physical group: int N_n dA over a
/// surface, likewise over a curve or volume; equal over points. On straight
/// second-order triangles the corners' share is zero.
[[nodiscard]] WeightedNodes weigh_group(const Mesh& mesh,
                                        const PhysicalGroup& group);

/// Every node the same share.
[[nodiscard]] WeightedNodes weigh_equally(std::vector<int> nodes);

/// Boundary nodes near a region.
struct NearNodes {
  std::vector<int> nodes;  ///< sorted node indices
  double nearest = 0.0;    ///< distance of the nearest of all nodes [m]
};

/// Boundary nodes whose `distance` [m] from a region is `tolerance` or less.
[[nodiscard]] NearNodes find_boundary_nodes(
    const Mesh& mesh, const std::function<double(const Vector3&)>& distance,
    double tolerance);

/// Shares of a load spread evenly over the boundary faces that lie wholly in
/// `nodes`; equal shares if there is no such face.
[[nodiscard]] WeightedNodes weigh_boundary(const Mesh& mesh,
                                           const std::vector<int>& nodes);

/// Node with this Gmsh tag. @throws InputError.
[[nodiscard]] int find_tagged_node(const Mesh& mesh, std::size_t tag);

/// Node nearest to a point [m].
[[nodiscard]] int find_nearest_node(const Mesh& mesh, const Vector3& point);

}  // namespace limber::fem
