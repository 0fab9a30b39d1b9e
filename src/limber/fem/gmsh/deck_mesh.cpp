// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/gmsh/deck_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/length_unit.hpp"

namespace limber::fem {
namespace {

/// The elements of `block` at `places`, in that order.
RawBlock choose(const RawBlock& block, const std::vector<std::size_t>& places) {
  const auto each = static_cast<std::size_t>(block.nodes_each);
  RawBlock chosen{block.type, block.nodes_each, {}, {}, {}};
  for (const std::size_t e : places) {
    const auto first =
        block.nodes.begin() + static_cast<std::ptrdiff_t>(e * each);
    chosen.elements.push_back(block.elements[e]);
    chosen.regions.push_back(block.regions[e]);
    chosen.nodes.insert(chosen.nodes.end(), first,
                        first + static_cast<std::ptrdiff_t>(each));
  }
  return chosen;
}

/// One region after the other.
RawBlock sort_by_region(const RawBlock& block) {
  std::vector<std::size_t> places(block.elements.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::ranges::stable_sort(places, {},
                           [&](std::size_t e) { return block.regions[e]; });
  return choose(block, places);
}

/// The elements of the regions that belong to a volume group.
RawBlocks find_volume(const SolidDeck& deck, const std::string& name) {
  const auto is_in = [&](int region) {
    const auto& names = deck.region_groups[static_cast<std::size_t>(region)];
    return std::ranges::count(names, name) > 0;
  };
  RawBlocks volume;
  for (const auto& [type, block] : deck.solids) {
    std::vector<std::size_t> places;
    for (std::size_t e = 0; e < block.elements.size(); ++e)
      if (is_in(block.regions[e])) places.push_back(e);
    if (!places.empty()) volume[type] = choose(block, places);
  }
  return volume;
}

/// In the order of the regions.
std::vector<std::string> list_volumes(const SolidDeck& deck) {
  std::vector<std::string> names;
  for (const std::vector<std::string>& of_region : deck.region_groups)
    std::ranges::copy_if(of_region, std::back_inserter(names),
                         [&](const std::string& name) {
                           return std::ranges::count(names, name) == 0;
                         });
  return names;
}

/// Stress is force / length^2, density force time^2 / length^4 with seconds.
void convert(double unit, double force, SolidMaterial& material) {
  const double stress = force / (unit * unit);
  material.youngs_modulus *= stress;
  material.density *= stress / (unit * unit);
  if (!material.anisotropy) return;
  material.anisotropy->C *= stress;
  material.anisotropy->axes.point *= unit;
}

/// Empty if there are none. Decks in inches or feet have forces in pounds or in
/// newtons: the user must state it.
std::vector<RegionMaterial> to_si(std::vector<RegionMaterial> materials,
                                  const MeshOptions& options) {
  const auto is_nameless = [](const RegionMaterial& m) {
    return m.name.empty();
  };
  if (std::ranges::all_of(materials, is_nameless)) return {};
  const double unit = options.unit;
  for (RegionMaterial& stated : materials) {
    if (is_nameless(stated)) continue;
    if (options.force == 0.0 && !is_metric(unit) && stated.problem.empty())
      stated.problem = fmt::format(
          "{} is in a unit of force that is not known, as lengths are in {:g} "
          "m. Expected the deck's unit of force (force unit N or lbf, for "
          "example), or a material in its place.",
          stated.name, unit);
    convert(unit, options.force == 0.0 ? 1.0 : options.force, stated.material);
  }
  return materials;
}

/// Masses are force time^2 / length, with seconds.
std::vector<NodeMass> to_si(const std::map<std::size_t, double>& masses,
                            const NodeIndex& index,
                            const std::filesystem::path& file,
                            const MeshOptions& options) {
  if (!masses.empty() && options.force == 0.0 && !is_metric(options.unit))
    throw InputError(fmt::format(
        "{}: its point masses are in a unit of force that is not known, as "
        "lengths are in {:g} m. Expected the deck's unit of force (force unit "
        "N or lbf, for example).",
        file.string(), options.unit));
  const double force = options.force == 0.0 ? 1.0 : options.force;
  std::vector<NodeMass> list;
  for (const auto& [node, mass] : masses)
    if (mass > 0.0)
      list.push_back({index.of(node), mass * force / options.unit});
  return list;
}

}  // namespace

RawMesh make_deck_mesh(const std::filesystem::path& file, SolidDeck deck,
                       const MeshOptions& options) {
  const double unit = options.unit;
  if (deck.solids.empty())
    throw InputError(fmt::format(
        "{}: the deck has no solid elements. Expected tetrahedra, hexahedra, "
        "wedges or pyramids.",
        file.string()));
  for (auto& [type, block] : deck.solids) block = sort_by_region(block);
  const NodeIndex index({deck.solids});
  RawMesh raw;
  raw.notices = std::move(deck.notices);
  Mesh& mesh = raw.mesh;
  mesh.source = file.string();
  ElementTypes types(mesh.source);
  for (const auto& [type, block] : deck.solids)
    mesh.blocks.push_back(make_block(block, index, types));
  mesh.volume_groups = deck.region_groups;
  mesh.materials = to_si(std::move(deck.materials), options);
  mesh.masses = to_si(deck.masses, index, file, options);
  for (const std::string& name : list_volumes(deck))
    mesh.groups.push_back(
        make_group(name, 3, find_volume(deck, name), index, types));
  for (const DeckGroup& group : deck.groups) {
    PhysicalGroup made =
        make_group(group.name, group.dimension, group.elements, index, types);
    if (!made.nodes.empty()) mesh.groups.push_back(std::move(made));
  }
  mesh.tags = index.tags();
  mesh.x.resize(3, static_cast<Eigen::Index>(mesh.tags.size()));
  for (std::size_t i = 0; i < deck.nodes.size(); ++i) {
    const int node = index.of(deck.nodes[i]);
    if (node >= 0)
      mesh.x.col(node) = unit * deck.x.col(static_cast<Eigen::Index>(i));
  }
  return raw;
}

}  // namespace limber::fem
