// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "limber/common/types.hpp"
#include "limber/fem/mesh/mesh.hpp"

namespace limber::fem {

/// Numbers of nodes or elements in a file.
using Tags = std::vector<std::size_t>;

/// Elements of one type as they are read, nodes by tag.
struct RawBlock {
  int type = 0;  ///< Gmsh's number
  int nodes_each = 0;
  Tags elements;
  Tags nodes;
  std::vector<int> regions;
};
/// By type.
using RawBlocks = std::map<int, RawBlock>;

/// A named group of faces, edges or nodes.
struct DeckGroup {
  std::string name;
  int dimension = 0;   ///< 0 nodes, 1 edges, 2 faces [-]
  RawBlocks elements;  ///< nodes as elements of one node
};

/// Nodes and solid elements of a finite-element program's input.
struct SolidDeck {
  Tags nodes;        ///< ascending
  Matrix3X x;        ///< beside nodes, in the global axes [deck units]
  RawBlocks solids;  ///< regions as indices into region_groups
  /// Volume groups of each region.
  std::vector<std::vector<std::string>> region_groups;
  /// Of each region, in the deck's units of length and force, and seconds;
  /// empty if it states none at all.
  std::vector<RegionMaterial> materials;
  std::map<std::size_t, double> masses;  ///< point masses, by node
  std::vector<DeckGroup> groups;
  /// Parts of the file without effect here, and nodes without a solid.
  std::vector<std::string> notices;
};

}  // namespace limber::fem
