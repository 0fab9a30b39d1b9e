// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "limber/common/material/solid_material.hpp"
#include "limber/common/types.hpp"
#include "limber/fem/mesh/reference_element.hpp"

namespace limber::fem {

/// Elements of one type. Nodes are indices into Mesh::x.
struct ElementBlock {
  std::shared_ptr<const ReferenceElement> element;
  std::vector<std::size_t> tags;  ///< Gmsh element tags
  std::vector<int> nodes;  ///< size() * node_count indices, Gmsh node order
  /// Index into Mesh::volume_groups of each element.
  std::vector<int> regions;

  [[nodiscard]] std::size_t size() const { return tags.size(); }
  [[nodiscard]] const int* element_nodes(std::size_t index) const {
    return nodes.data() + index * static_cast<std::size_t>(element->node_count);
  }
};

/// A named physical group.
struct PhysicalGroup {
  std::string name;
  int dimension = 0;       ///< 0 point, 1 curve, 2 surface, 3 volume [-]
  std::vector<int> nodes;  ///< sorted node indices
  std::vector<ElementBlock> blocks;  ///< its elements (regions unused)
};

/// Material of a region as stated in a file.
struct RegionMaterial {
  std::string name;        ///< in the file; empty: none
  SolidMaterial material;  ///< in SI units
  /// Why it cannot be used; empty: it can.
  std::string problem;
};

/// A point mass at a node.
struct NodeMass {
  int node = 0;       ///< index into Mesh::x
  double mass = 0.0;  ///< > 0 [kg]
};

/// A face of one solid element that no other shares: part of the surface.
struct BoundaryFace {
  int block = 0;            ///< index into Mesh::blocks
  std::size_t element = 0;  ///< index in the block
  int face = 0;             ///< local index of the face
};

/// A valid solid mesh: one connected part, every element with a positive
/// Jacobian, every node used. Lengths in metres.
struct Mesh {
  std::string source;                 ///< file name, for messages
  Matrix3X x;                         ///< 3 x N node positions [m]
  std::vector<std::size_t> tags;      ///< Gmsh node tags
  std::vector<ElementBlock> blocks;   ///< solid elements
  std::vector<PhysicalGroup> groups;  ///< all named groups
  /// Per region (geometric volume): the physical groups that it belongs to.
  std::vector<std::vector<std::string>> volume_groups;
  /// Of each region by its file; empty if that states none at all.
  std::vector<RegionMaterial> materials;
  std::vector<NodeMass> masses;  ///< of its file, beside the elements'
  std::vector<BoundaryFace> boundary_faces;
  std::vector<int> boundary_nodes;  ///< sorted indices

  [[nodiscard]] std::size_t node_count() const { return tags.size(); }
  [[nodiscard]] std::size_t element_count() const;
  /// Edges of the axis-aligned bounding box [m].
  [[nodiscard]] Vector3 size() const;
};

/// Whether all elements are of first order.
[[nodiscard]] bool is_first_order(const Mesh& mesh);

/// Index of the group called `name`. @throws InputError, naming the nearest.
[[nodiscard]] std::size_t find_group(const Mesh& mesh, const std::string& name);

/// Node indices that are not in `held` (sorted).
[[nodiscard]] std::vector<int> find_free_nodes(const Mesh& mesh,
                                               const std::vector<int>& held);

/// Node indices of one boundary face, corners first.
[[nodiscard]] std::vector<int> face_nodes(const Mesh& mesh,
                                          const BoundaryFace& face);

/// The surface as linear triangles on corner and mid-side nodes: node indices,
/// counter-clockwise seen from outside.
[[nodiscard]] std::vector<std::array<int, 3>> boundary_triangles(
    const Mesh& mesh);

}  // namespace limber::fem
