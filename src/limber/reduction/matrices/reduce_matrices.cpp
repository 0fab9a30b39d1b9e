// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/matrices/reduce_matrices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/length_unit.hpp"
#include "limber/fem/matrices/read_matrices.hpp"
#include "limber/fem/sections/sectioned_mesh.hpp"
#include "limber/fem/structural/assemble_structure.hpp"
#include "limber/fem/structural/read_structure.hpp"
#include "limber/reduction/matrices/matrix_inertia.hpp"
#include "limber/reduction/matrices/matrix_interfaces.hpp"
#include "limber/reduction/matrices/section_rows.hpp"
#include "limber/reduction/modal/kept_rows.hpp"
#include "limber/reduction/modal/selection.hpp"
#include "limber/reduction/modal/static_modes.hpp"

namespace limber::flexbody {
namespace {

/// Modes on all rows of the system, zero on those that are held.
MatrixX put_system_rows(const MatrixX& Phi, const std::vector<int>& rows,
                        Eigen::Index count) {
  MatrixX all = MatrixX::Zero(count, Phi.cols());
  all(rows, Eigen::all) = Phi;
  return all;
}

std::vector<int> choose_nodes(const MatrixSystem& system, const Recipe& recipe,
                              const std::vector<Interface>& interfaces) {
  using Extent = KeptRows::Extent;
  std::set<int> kept;
  const auto keep = [&](const std::vector<int>& nodes) {
    for (const int node : nodes)
      if (system.is_moving[static_cast<std::size_t>(node)]) kept.insert(node);
  };
  if (recipe.rows.extent != Extent::groups)
    for (int n = 0; n < static_cast<int>(system.tags.size()); ++n)
      if (system.is_moving[static_cast<std::size_t>(n)]) kept.insert(n);
  for (const std::string& name : recipe.rows.groups)
    keep(find_matrix_nodes(system, name));
  for (const Interface& interface : interfaces) keep(interface.selection.nodes);
  return {kept.begin(), kept.end()};
}

std::vector<std::size_t> tags_of(const MatrixSystem& system,
                                 const std::vector<int>& nodes) {
  std::vector<std::size_t> tags;
  for (const int node : nodes)
    tags.push_back(system.tags[static_cast<std::size_t>(node)]);
  return tags;
}

/// @param fields 6N x m of all nodes
void keep_nodes(const MatrixBody& meshed, const Recipe& recipe,
                const MatrixX& fields, ReducedBody& body) {
  const MatrixSystem& system = meshed.part->system;
  const std::vector<int> kept = choose_nodes(system, recipe, meshed.interfaces);
  body.rows.tags = tags_of(system, kept);
  body.rows.x_B =
      Matrix3X(system.x(Eigen::all, kept)).colwise() - body.p_MoBcm_M;
  body.rows.Phi_B.resize(3 * std::ssize(kept), fields.cols());
  for (std::size_t i = 0; i < kept.size(); ++i)
    body.rows.Phi_B.middleRows<3>(3 * static_cast<Eigen::Index>(i)) =
        fields.middleRows<3>(field_row(kept[i], 0));
  body.triangles = find_kept_elements(system.triangles, kept);
  for (const fem::MatrixNodeSet& set : system.sets) {
    const auto is_kept = [&](int node) {
      return std::binary_search(kept.begin(), kept.end(), node);
    };
    if (set.nodes.empty() ||
        !std::all_of(set.nodes.begin(), set.nodes.end(), is_kept))
      continue;
    const auto count = static_cast<double>(set.nodes.size());
    body.groups.push_back(
        {set.name, 0, tags_of(system, set.nodes),
         VectorX::Constant(std::ssize(set.nodes), 1.0 / count)});
  }
}

void add_interfaces(const MatrixBody& meshed, const StaticModes& modes,
                    const MatrixX& fields, ReducedBody& body) {
  for (std::size_t i = 0; i < meshed.interfaces.size(); ++i) {
    const Interface& interface = meshed.interfaces[i];
    const Matrix6X table = interface.motion.apply(fields);
    body.interfaces.push_back(
        {interface.name, interface.motion.mean_point() - body.p_MoBcm_M,
         table.topRows<3>(), table.bottomRows<3>(),
         interface.motion.rotation_axes(), interface.selection.nodes.size(),
         modes.flexibility[i]});
  }
}

/// @param structure in lengths of `unit`
std::shared_ptr<const MatrixPart> assemble_part(
    const fem::Structure& structure, const fem::StructureSolids& solids,
    double unit, const Progress& progress) {
  report(progress, "assembling", 0.0);
  fem::AssembledStructure assembled =
      fem::assemble_structure(structure, solids);
  if (!(assembled.mass > 0.0))
    throw InputError(
        fmt::format("{}: its elements have no mass. Expected the density of "
                    "its materials (RHO, *DENSITY).",
                    structure.source));
  return make_matrix_part(std::move(assembled.model), assembled.mass / unit,
                          unit, progress);
}

/// Beams and shells on groups of a mesh.
std::shared_ptr<const MatrixPart> read_sectioned_part(const MeshSource& source,
                                                      const Progress& progress,
                                                      PartOrigin* origin) {
  if (source.force > 0.0 || !source.ignored.empty())
    throw InputError(fmt::format(
        "{}: a unit of force or cards to ignore were given, which go with a "
        "deck. Expected none.",
        source.file.string()));
  fem::MeshSections sections{source.sections.shells, source.sections.beams, {}};
  for (const MaterialRegion& region : source.sections.materials)
    sections.materials.push_back({region.group, region.material});
  report(progress, "reading the mesh", 0.0);
  fem::SectionedMesh made = fem::read_sectioned_mesh(
      source.file, {source.size, source.order, source.unit}, sections,
      progress);
  if (origin != nullptr) {
    origin->stamps = std::move(made.files);
    origin->is_repeatable = made.is_repeatable;
  }
  return assemble_part(made.structure, made.solids, 1.0, progress);
}

/// Beams and shells of a deck.
std::shared_ptr<const MatrixPart> read_structure_part(const MeshSource& source,
                                                      double unit,
                                                      const Progress& progress,
                                                      PartOrigin* origin) {
  if (source.size > 0.0 || source.order > 0)
    throw InputError(
        fmt::format("{}: a mesh size or order was given, but its beams and "
                    "shells are elements already. Expected none.",
                    source.file.string()));
  if (source.force == 0.0 && !is_metric(unit))
    throw InputError(fmt::format(
        "{}: its unit of force is not known, as lengths are in {:g} m. "
        "Expected "
        "the deck's unit of force (force unit N or lbf, for example).",
        source.file.string(), unit));
  const double force = source.force == 0.0 ? 1.0 : source.force;
  report(progress, "reading beams and shells", 0.0);
  fem::Structure structure = fem::read_structure(source.file, source.ignored);
  fem::convert_forces(structure, force);
  if (origin != nullptr) origin->paths = structure.files;
  if (structure.has_solids) report(progress, "reading solids", 0.0);
  const fem::StructureSolids solids =
      fem::read_structure_solids(structure, unit, force);
  return assemble_part(structure, solids, unit, progress);
}

}  // namespace

bool is_node_model(const MeshSource& source) {
  return source.is_matrices() || !source.sections.empty() ||
         fem::is_structure(source.file, source.ignored);
}

std::shared_ptr<const MatrixPart> read_matrix_part(const MeshSource& source,
                                                   const Progress& progress,
                                                   PartOrigin* origin) {
  if (!source.sections.empty())
    return read_sectioned_part(source, progress, origin);
  const double unit = source.unit > 0.0 ? source.unit : 1.0;
  if (!source.is_matrices())
    return read_structure_part(source, unit, progress, origin);
  report(progress, "reading the matrices", 0.0);
  return make_matrix_part(
      fem::read_matrices({source.matrices.paths, source.matrices.recovery}),
      source.matrices.mass, unit, progress);
}

ReducedBody reduce_matrices(const Recipe& recipe,
                            const std::shared_ptr<const MatrixPart>& part,
                            const Progress& progress,
                            const SurfaceMaker& make_surfaces) {
  report(progress, "factorising", 0.0);
  const MatrixBody meshed(recipe, part);
  const MatrixSystem& system = part->system;
  const ChosenModes chosen = choose_eigenmodes(meshed, recipe, progress);
  report(progress, "static-deformation modes", 0.0);
  const StaticModes modes =
      find_static_modes(meshed, recipe, chosen.eigenmodes);
  const ReducedBasis basis =
      join_basis(meshed, chosen.eigenmodes, modes, recipe.basis.drop_tolerance);
  const MatrixX Phi =
      put_system_rows(basis.Phi, meshed.rows, system.row_count());
  const MatrixX fields = meshed.support.on_all(basis.Phi);

  ReducedBody body;
  body.name = recipe.name;
  body.clamped = meshed.support.is_clamped;
  body.mass = part->inertia.mass;
  body.p_MoBcm_M = part->inertia.center;
  body.size = system.size();
  report(progress, "inertia integrals", 0.0);
  MatrixInertia inertia =
      find_matrix_inertia(*part, basis, Phi, fields, meshed.support.is_clamped);
  body.integrals = std::move(inertia.integrals);
  body.inertia_record = std::move(inertia.record);
  body.levers = inertia.levers;
  body.lambda = basis.lambda;
  body.selection = finish_record(chosen, basis);
  body.load_modes = modes.loads;
  body.mesh_nodes = system.node_count();
  body.mesh_boundary_nodes = system.node_count();
  keep_nodes(meshed, recipe, fields, body);
  add_interfaces(meshed, modes, fields, body);
  if (make_surfaces)
    body.contact_surfaces =
        make_surfaces(meshed, basis, fields, body.p_MoBcm_M);
  if (recipe.stress)
    body.stress = make_section_stress(
        meshed, choose_nodes(system, recipe, meshed.interfaces), Phi);
  report(progress, "reduced", 1.0);
  return body;
}

}  // namespace limber::flexbody
