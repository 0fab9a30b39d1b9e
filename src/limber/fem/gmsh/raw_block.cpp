// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/gmsh/raw_block.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/common/errors.hpp"

namespace limber::fem {

std::shared_ptr<const ReferenceElement> ElementTypes::get(int gmsh_type) {
  auto& entry = types_[gmsh_type];
  if (!entry) entry = make(gmsh_type);
  return entry;
}

std::shared_ptr<const ReferenceElement> ElementTypes::make(
    int gmsh_type) const {
  try {
    return std::make_shared<const ReferenceElement>(
        make_reference_element(gmsh_type));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", source_, error.what()));
  }
}

NodeIndex::NodeIndex(const std::vector<RawBlocks>& parts) {
  for (const RawBlocks& part : parts)
    for (const auto& [type, block] : part)
      used_.insert(block.nodes.begin(), block.nodes.end());
  int next = 0;
  for (const std::size_t tag : used_) index_[tag] = next++;
}

ElementBlock make_block(const RawBlock& raw, const NodeIndex& index,
                        ElementTypes& types) {
  ElementBlock block;
  block.element = types.get(raw.type);
  const auto each = static_cast<std::size_t>(raw.nodes_each);
  for (std::size_t e = 0; e < raw.elements.size(); ++e) {
    std::vector<int> nodes;
    for (std::size_t i = 0; i < each; ++i)
      nodes.push_back(index.of(raw.nodes[e * each + i]));
    if (std::count(nodes.begin(), nodes.end(), -1) > 0) continue;
    block.tags.push_back(raw.elements[e]);
    block.regions.push_back(raw.regions[e]);
    block.nodes.insert(block.nodes.end(), nodes.begin(), nodes.end());
  }
  return block;
}

PhysicalGroup make_group(const std::string& name, int dimension,
                         const RawBlocks& blocks, const NodeIndex& index,
                         ElementTypes& types) {
  PhysicalGroup group;
  group.name = name;
  group.dimension = dimension;
  std::set<int> nodes;
  for (const auto& [type, block] : blocks) {
    group.blocks.push_back(make_block(block, index, types));
    nodes.insert(group.blocks.back().nodes.begin(),
                 group.blocks.back().nodes.end());
  }
  group.nodes.assign(nodes.begin(), nodes.end());
  return group;
}

}  // namespace limber::fem
