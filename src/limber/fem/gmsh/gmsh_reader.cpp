// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/gmsh/gmsh_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmsh.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/fem/abaqus/solid_deck_reader.hpp"
#include "limber/fem/gmsh/deck_mesh.hpp"
#include "limber/fem/gmsh/gmsh_session.hpp"
#include "limber/fem/gmsh/mesh_losses.hpp"
#include "limber/fem/gmsh/mesh_size.hpp"
#include "limber/fem/gmsh/promotion.hpp"
#include "limber/fem/gmsh/raw_block.hpp"
#include "limber/fem/mesh/mesh_checks.hpp"
#include "limber/fem/mesh/mesh_file_kind.hpp"
#include "limber/fem/mesh/mesh_reader.hpp"
#include "limber/fem/nastran/bulk_data.hpp"

namespace limber::fem {
namespace {

/// Runs a Gmsh call and turns its errors into an InputError.
template <typename Call>
void guarded(const GmshSession& session, const std::filesystem::path& file,
             const std::string& doing, const Call& call) {
  bool has_failed = false;
  try {
    call();
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (...) {  // Gmsh throws ints and strings, by version
    has_failed = true;
  }
  const std::vector<std::string> errors = session.errors();
  if (!has_failed && errors.empty()) return;
  throw InputError(
      fmt::format("{}: Gmsh cannot {} it: {}", file.string(), doing,
                  errors.empty() ? "no reason given"
                                 : fmt::format("{}", fmt::join(errors, "; "))));
}

bool has_elements(int dimension) {
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types, dimension);
  return !types.empty();
}

bool has_volumes() {
  gmsh::vectorpair volumes;
  gmsh::model::getEntities(volumes, 3);
  return !volumes.empty();
}

/// Beams and shells are of first order, and so is a mesh of them alone, unless
/// the geometry wants another.
void open_geometry(GmshSession& session, const std::filesystem::path& file,
                   const MeshOptions& options) {
  session.open(file);
  if (!options.with_surfaces || has_volumes()) return;
  gmsh::option::setNumber("Mesh.ElementOrder", 1);
  session.open(file);
}

void mesh_geometry(const std::filesystem::path& file,
                   const MeshOptions& options, const CountNote& note) {
  check_element_size(file, options.size);
  if (options.size > 0.0) {
    gmsh::option::setNumber("Mesh.MeshSizeMin", options.size);
    gmsh::option::setNumber("Mesh.MeshSizeMax", options.size);
  }
  if (options.order > 0)
    gmsh::option::setNumber("Mesh.ElementOrder", options.order);
  const int dimension = gmsh::model::getDimension();
  if (has_elements(options.with_surfaces ? dimension : 3)) return;
  if (note) note(estimate_element_count(options.size));
  gmsh::model::mesh::generate(3);
}

void append_entity(RawBlocks& blocks, int dimension, int entity, int region) {
  std::vector<int> types;
  std::vector<Tags> elements;
  std::vector<Tags> nodes;
  gmsh::model::mesh::getElements(types, elements, nodes, dimension, entity);
  for (std::size_t i = 0; i < types.size(); ++i) {
    if (elements[i].empty()) continue;
    RawBlock& block = blocks[types[i]];
    block.type = types[i];
    block.nodes_each = static_cast<int>(nodes[i].size() / elements[i].size());
    block.elements.insert(block.elements.end(), elements[i].begin(),
                          elements[i].end());
    block.nodes.insert(block.nodes.end(), nodes[i].begin(), nodes[i].end());
    block.regions.insert(block.regions.end(), elements[i].size(), region);
  }
}

/// A physical group, not yet tied to the solid's nodes.
struct RawGroup {
  std::string name;
  int dimension = 0;
  std::vector<int> entities;
};

std::vector<RawGroup> read_groups() {
  gmsh::vectorpair dim_tags;
  gmsh::model::getPhysicalGroups(dim_tags);
  std::vector<RawGroup> groups;
  for (const auto& [dimension, tag] : dim_tags) {
    RawGroup group;
    group.dimension = dimension;
    gmsh::model::getPhysicalName(dimension, tag, group.name);
    if (group.name.empty()) group.name = std::to_string(tag);
    gmsh::model::getEntitiesForPhysicalGroup(dimension, tag, group.entities);
    groups.push_back(std::move(group));
  }
  return groups;
}

[[noreturn]] void fail_without_volume(const std::filesystem::path& file) {
  gmsh::vectorpair surfaces;
  gmsh::model::getEntities(surfaces, 2);
  throw InputError(fmt::format(
      "{}: the geometry has {} but no volume, so no solid elements. Expected a "
      "closed solid; a .geo needs its Volume; or a <shell>, which gives "
      "surfaces "
      "a thickness.",
      file.string(), surfaces.empty() ? "no surfaces" : "surfaces"));
}

[[noreturn]] void fail_without_solids(const std::filesystem::path& file,
                                      bool is_geometry) {
  gmsh::vectorpair volumes;
  gmsh::model::getEntities(volumes, 3);
  if (is_geometry && volumes.empty()) fail_without_volume(file);
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types, 2);
  throw InputError(fmt::format(
      "{}: the mesh has {} but no solid elements. Expected tetrahedra, "
      "hexahedra, prisms or pyramids; mesh a volume (gmsh -3) and save it.",
      file.string(), types.empty() ? "no surfaces" : "surfaces"));
}

/// Solid elements of the whole model, and which groups each volume is in.
RawBlocks read_solids(const std::vector<RawGroup>& groups, bool is_geometry,
                      Mesh& mesh) {
  const bool only_grouped =
      is_geometry && std::any_of(groups.begin(), groups.end(),
                                 [](auto& g) { return g.dimension == 3; });
  gmsh::vectorpair volumes;
  gmsh::model::getEntities(volumes, 3);
  RawBlocks blocks;
  for (const auto& [dimension, entity] : volumes) {
    std::vector<std::string> names;
    for (const RawGroup& group : groups)
      if (group.dimension == 3 &&
          std::count(group.entities.begin(), group.entities.end(), entity) > 0)
        names.push_back(group.name);
    if (only_grouped && names.empty()) continue;
    append_entity(blocks, dimension, entity,
                  static_cast<int>(mesh.volume_groups.size()));
    mesh.volume_groups.push_back(names);
  }
  return blocks;
}

/// All elements of curves (1) or surfaces (2). Of a geometry with groups only
/// those in groups, as when Gmsh saves a mesh.
RawBlocks read_part(const std::vector<RawGroup>& groups, int dimension,
                    bool is_geometry) {
  const bool only_grouped =
      is_geometry && std::any_of(groups.begin(), groups.end(),
                                 [](auto& g) { return g.dimension > 0; });
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, dimension);
  RawBlocks blocks;
  for (const auto& one : entities) {
    const int entity = one.second;
    const bool is_grouped =
        std::any_of(groups.begin(), groups.end(), [&](const RawGroup& group) {
          return group.dimension == dimension &&
                 std::count(group.entities.begin(), group.entities.end(),
                            entity) > 0;
        });
    if (is_grouped || !only_grouped)
      append_entity(blocks, dimension, entity, 0);
  }
  return blocks;
}

PhysicalGroup read_group(const RawGroup& raw, const NodeIndex& index,
                         ElementTypes& types) {
  RawBlocks blocks;
  for (const int entity : raw.entities)
    append_entity(blocks, raw.dimension, entity, 0);
  return make_group(raw.name, raw.dimension, blocks, index, types);
}

void read_positions(const NodeIndex& index, double unit, Mesh& mesh) {
  mesh.tags = index.tags();
  mesh.x.resize(3, static_cast<Eigen::Index>(mesh.tags.size()));
  Tags tags;
  std::vector<double> x;
  std::vector<double> parameters;
  gmsh::model::mesh::getNodes(tags, x, parameters);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const int node = index.of(tags[i]);
    if (node >= 0)
      mesh.x.col(node) = unit * Eigen::Map<const Vector3>(x.data() + 3 * i);
  }
}

Mesh take_mesh(const std::filesystem::path& file, const MeshOptions& options,
               bool is_geometry) {
  Mesh mesh;
  mesh.source = file.string();
  const std::vector<RawGroup> groups = read_groups();
  const RawBlocks solids = read_solids(groups, is_geometry, mesh);
  std::vector<RawBlocks> parts = {solids};
  if (options.with_surfaces)
    for (const int dimension : {1, 2})
      parts.push_back(read_part(groups, dimension, is_geometry));
  else if (solids.empty())
    fail_without_solids(file, is_geometry);
  const NodeIndex index(parts);
  ElementTypes types(mesh.source);
  for (std::size_t dimension = 1; dimension < parts.size(); ++dimension)
    if (!parts[dimension].empty())
      mesh.groups.push_back(make_group("", static_cast<int>(dimension),
                                       parts[dimension], index, types));
  for (const auto& [type, block] : solids)
    mesh.blocks.push_back(make_block(block, index, types));
  for (const RawGroup& raw : groups) {
    PhysicalGroup group = read_group(raw, index, types);
    if (!group.nodes.empty()) mesh.groups.push_back(std::move(group));
  }
  read_positions(index, options.unit, mesh);
  return mesh;
}

/// The first problem with the mesh's elements, if any.
std::optional<std::string> find_flaw(const Mesh& mesh) {
  try {
    check_elements(mesh);
  } catch (const InputError& error) {
    return error.what();
  }
  return std::nullopt;
}

/// Edges that follow a curved surface may invert a thin element. Such a mesh is
/// made straight-sided, if that repairs it.
void straighten_curved(const std::filesystem::path& file,
                       const MeshOptions& options, RawMesh& raw) {
  int order = 1;
  for (const ElementBlock& block : raw.mesh.blocks)
    order = std::max(order, block.element->order);
  if (order < 2) return;
  const std::optional<std::string> flaw = find_flaw(raw.mesh);
  if (!flaw) return;
  gmsh::option::setNumber("Mesh.SecondOrderLinear", 1);
  gmsh::model::mesh::setOrder(1);
  gmsh::model::mesh::setOrder(order);
  Mesh straight = take_mesh(file, options, true);
  if (find_flaw(straight)) return;
  raw.notices.push_back(fmt::format(
      "{} So all edges were made straight (Mesh.SecondOrderLinear = 1), and "
      "the surface is that of a mesh of order 1. A smaller mesh size keeps "
      "curved edges.",
      flaw->substr(0, flaw->find(" Expected"))));
  raw.mesh = std::move(straight);
}

/// The unit to read with: that of the options, else the file's, else 1 m. A
/// notice is added if both differ.
double choose_unit(const std::filesystem::path& file, double wanted,
                   double stated, std::vector<std::string>& notices) {
  constexpr double kSame = 1e-6;
  if (wanted == 0.0) return stated > 0.0 ? stated : 1.0;
  if (stated > 0.0 && std::abs(wanted / stated - 1.0) > kSame)
    notices.push_back(fmt::format(
        "{}: the part is {:g} times as large as its file says, because it is "
        "read with unit {:g} m, which the mesh options set; without unit, "
        "lengths are those of the file.",
        file.string(), wanted / stated, wanted));
  return wanted;
}

RawMesh make_as_it_is(GmshSession& session, const std::filesystem::path& file,
                      MeshFileKind kind, MeshOptions options,
                      const CountNote& note) {
  std::optional<UnvContent> content;
  if (kind == MeshFileKind::universal) content = check_unv(file);
  std::vector<std::string> notices;
  options.unit =
      choose_unit(file, options.unit,
                  content ? content->unit : find_stated_unit(file), notices);
  if (kind == MeshFileKind::bulk_data)
    return make_deck_mesh(file, read_bulk_data(file, options.ignored), options);
  if (kind == MeshFileKind::input_deck)
    return make_deck_mesh(file, read_solid_deck(file, options.ignored),
                          options);
  const bool is_geometry = kind == MeshFileKind::geometry;
  // Before the file, so that the file may override it.
  gmsh::option::setNumber("Mesh.ElementOrder", 2);
  guarded(session, file, "read", [&] {
    if (is_geometry)
      open_geometry(session, file, options);
    else
      session.open(file);
  });
  gmsh::option::setNumber("General.NumThreads", 1);
  RawMesh raw;
  if (is_geometry)
    guarded(session, file, "mesh", [&] { mesh_geometry(file, options, note); });
  guarded(session, file, "use", [&] {
    raw.mesh = take_mesh(file, options, is_geometry);
    if (is_geometry) {
      check_merged_files(session, file);
      straighten_curved(file, options, raw);
    } else {
      if (content) check_counts(file, *content);
      if (!options.with_surfaces)
        raw.notices = find_mesh_losses(session, file, raw.mesh);
    }
  });
  raw.notices.insert(raw.notices.end(), notices.begin(), notices.end());
  return raw;
}

}  // namespace

RawMesh make_mesh(GmshSession& session, const std::filesystem::path& file,
                  const MeshOptions& options, const CountNote& note) {
  const MeshFileKind kind = find_mesh_file_kind(file);
  check_mesh_options(file, kind, options);
  RawMesh raw = make_as_it_is(session, file, kind, options, note);
  // A finished mesh, also one that a geometry merges.
  if (options.order == 2) promote_to_second_order(raw.mesh);
  return raw;
}

Mesh read_mesh_in_process(const std::filesystem::path& file,
                          const MeshOptions& options) {
  Mesh mesh;
  {
    GmshSession session;
    mesh = make_mesh(session, file, options).mesh;
  }
  complete_mesh(mesh);
  return mesh;
}

}  // namespace limber::fem
