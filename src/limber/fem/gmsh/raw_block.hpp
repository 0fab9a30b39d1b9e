// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "limber/fem/mesh/mesh.hpp"
#include "limber/fem/mesh/solid_deck.hpp"

namespace limber::fem {

/// A mesh as it is read or made, before complete_mesh().
struct RawMesh {
  Mesh mesh;
  /// Changes made to the mesh to make it usable.
  std::vector<std::string> notices;
};

/// Makes element types once and shares them.
class ElementTypes {
 public:
  /// @param source file name, for messages
  explicit ElementTypes(std::string source) : source_(std::move(source)) {}

  /// @throws InputError naming the file, for a type that is not supported.
  std::shared_ptr<const ReferenceElement> get(int gmsh_type);

 private:
  [[nodiscard]] std::shared_ptr<const ReferenceElement> make(
      int gmsh_type) const;

  std::string source_;
  std::map<int, std::shared_ptr<const ReferenceElement>> types_;
};

/// Index of each node tag that an element of the parts uses; -1 elsewhere.
class NodeIndex {
 public:
  explicit NodeIndex(const std::vector<RawBlocks>& parts);
  [[nodiscard]] int of(std::size_t tag) const {
    const auto found = index_.find(tag);
    return found == index_.end() ? -1 : found->second;
  }
  [[nodiscard]] Tags tags() const { return {used_.begin(), used_.end()}; }

 private:
  std::set<std::size_t> used_;
  std::unordered_map<std::size_t, int> index_;
};

/// With nodes as indices; elements with other nodes are omitted.
[[nodiscard]] ElementBlock make_block(const RawBlock& raw,
                                      const NodeIndex& index,
                                      ElementTypes& types);

[[nodiscard]] PhysicalGroup make_group(const std::string& name, int dimension,
                                       const RawBlocks& blocks,
                                       const NodeIndex& index,
                                       ElementTypes& types);

}  // namespace limber::fem
