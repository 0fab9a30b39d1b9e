// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/gmsh/bulk_mesh.hpp"

#include <fmt/format.h>

#include <map>
#include <set>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/fem/nastran/bulk_data.hpp"

namespace limber::fem {
namespace {

/// Elements of each property.
std::map<int, RawBlocks> sort_by_property(const BulkData& data) {
  std::map<int, RawBlocks> sorted;
  for (const BulkSolids& solids : data.solids) {
    const auto each = static_cast<std::size_t>(solids.nodes_each);
    for (std::size_t e = 0; e < solids.elements.size(); ++e) {
      RawBlock& block = sorted[solids.properties[e]][solids.gmsh_type];
      block.type = solids.gmsh_type;
      block.nodes_each = solids.nodes_each;
      block.elements.push_back(solids.elements[e]);
      block.regions.push_back(0);
      const auto first =
          solids.nodes.begin() + static_cast<std::ptrdiff_t>(e * each);
      block.nodes.insert(block.nodes.end(), first,
                         first + static_cast<std::ptrdiff_t>(each));
    }
  }
  return sorted;
}

/// The properties one after the other, as regions.
RawBlocks join_properties(const std::map<int, RawBlocks>& sorted) {
  RawBlocks joined;
  int region = 0;
  for (const auto& [property, blocks] : sorted) {
    for (const auto& [type, part] : blocks) {
      RawBlock& block = joined[type];
      block.type = type;
      block.nodes_each = part.nodes_each;
      block.elements.insert(block.elements.end(), part.elements.begin(),
                            part.elements.end());
      block.nodes.insert(block.nodes.end(), part.nodes.begin(),
                         part.nodes.end());
      block.regions.insert(block.regions.end(), part.elements.size(), region);
    }
    ++region;
  }
  return joined;
}

}  // namespace

RawMesh read_bulk_mesh(const std::filesystem::path& file, double unit) {
  BulkData data = read_bulk_data(file);
  if (data.solids.empty())
    throw InputError(fmt::format(
        "{}: the deck has no solid elements. Expected CTETRA, CPENTA, CHEXA or "
        "CPYRAM.",
        file.string()));
  const std::map<int, RawBlocks> sorted = sort_by_property(data);
  const RawBlocks solids = join_properties(sorted);
  const NodeIndex index(solids);
  RawMesh raw;
  raw.notices = std::move(data.notices);
  Mesh& mesh = raw.mesh;
  mesh.source = file.string();
  ElementTypes types(mesh.source);
  for (const auto& [type, block] : solids)
    mesh.blocks.push_back(make_block(block, index, types));
  for (const auto& [property, blocks] : sorted) {
    const std::string name = std::to_string(property);
    mesh.volume_groups.push_back({name});
    mesh.groups.push_back(make_group(name, 3, blocks, index, types));
  }
  mesh.tags = index.tags();
  mesh.x.resize(3, static_cast<Eigen::Index>(mesh.tags.size()));
  for (std::size_t i = 0; i < data.grids.size(); ++i) {
    const int node = index.of(data.grids[i]);
    if (node >= 0)
      mesh.x.col(node) = unit * data.x.col(static_cast<Eigen::Index>(i));
  }
  return raw;
}

}  // namespace limber::fem
