// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/meshed_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "limber/fem/solid/hooke.hpp"
#include "limber/fem/solid/locking.hpp"
#include "limber/reduction/contact_groups.hpp"
#include "limber/reduction/modal/selection.hpp"

namespace limber::flexbody {
fem::TracedMesh read_source(const MeshSource& source,
                            const Progress& progress) {
  report(progress, "reading the mesh", 0.0);
  return fem::read_traced_mesh(
      source.file,
      {source.size, source.order, source.unit, source.force, source.ignored},
      progress);
}

fem::Elasticity find_elasticity(MaterialLaw law) {
  return law == MaterialLaw::neo_hookean ? fem::Elasticity::neo_hookean
                                         : fem::Elasticity::st_venant_kirchhoff;
}

namespace {

std::vector<fem::MaterialAssignment> list_assignments(const Recipe& recipe) {
  std::vector<fem::MaterialAssignment> assignments;
  for (const MaterialRegion& region : recipe.materials)
    assignments.push_back({region.group, region.material});
  return assignments;
}

}  // namespace

std::vector<fem::ElasticMaterial> find_materials(const fem::Mesh& mesh,
                                                 const Recipe& recipe) {
  std::vector<fem::ElasticMaterial> materials =
      fem::assign_materials(mesh, list_assignments(recipe));
  if (recipe.manifold)
    fem::require_law(mesh, materials, find_elasticity(recipe.law));
  return materials;
}

std::vector<std::string> find_file_materials(const fem::Mesh& mesh,
                                             const Recipe& recipe) {
  return fem::describe_file_materials(mesh, list_assignments(recipe));
}

namespace {

/// Checks all names in the recipe before assembling, so that errors are found
/// before long work.
fem::StructuralMatrices assemble_checked(
    const fem::Mesh& mesh, const Recipe& recipe,
    const std::vector<Interface>& interfaces, const Progress& progress) {
  const std::vector<fem::ElasticMaterial> materials =
      find_materials(mesh, recipe);
  static_cast<void>(find_pattern_loads(
      3 * static_cast<Eigen::Index>(mesh.node_count()), recipe, interfaces));
  check_basis(recipe);
  for (const auto* names : {&recipe.clamped_groups, &recipe.rows.groups})
    for (const std::string& name : *names)
      static_cast<void>(fem::find_group(mesh, name));
  static_cast<void>(
      find_contact_groups(mesh, recipe.contact_groups, materials));
  return fem::assemble(mesh, materials, progress);
}

}  // namespace

struct MeshedBody::Parts {
  Parts(const Recipe& recipe, std::shared_ptr<const fem::TracedMesh> traced,
        const Progress& progress)
      : made(std::move(traced)),
        interfaces(find_interfaces(made->mesh, recipe)) {
    fem::StructuralMatrices matrices =
        assemble_checked(made->mesh, recipe, interfaces, progress);
    M_s = matrices.M_s;
    support = make_support(made->mesh, recipe, std::move(matrices));
    x_free = made->mesh.x(Eigen::all, support.free_nodes);
  }

  std::shared_ptr<const fem::TracedMesh> made;
  std::vector<Interface> interfaces;
  fem::SparseMatrix M_s;
  Support support;
  Matrix3X x_free;
};

MeshedBody::MeshedBody(const Recipe& recipe, const Progress& progress)
    : MeshedBody(recipe,
                 std::make_shared<const fem::TracedMesh>(
                     read_source(recipe.mesh, progress)),
                 progress) {}

MeshedBody::MeshedBody(const Recipe& recipe,
                       std::shared_ptr<const fem::TracedMesh> traced,
                       const Progress& progress)
    : MeshedBody(Parts(recipe, std::move(traced), progress), progress) {}

MeshedBody::MeshedBody(Parts parts, const Progress& progress)
    : ElasticBody(parts.made->mesh.source, std::move(parts.interfaces),
                  std::move(parts.support), parts.x_free, progress),
      made(std::move(parts.made)),
      mesh(made->mesh),
      M_s(std::move(parts.M_s)) {}

std::optional<MeshLocking> find_locking(const MeshedBody& body,
                                        const Recipe& recipe,
                                        const VectorX& lambda,
                                        const MatrixX& Phi) {
  // Locking may change the order of the lowest modes.
  constexpr Eigen::Index kModes = 4;
  const Eigen::Index count = std::min(kModes, lambda.size());
  if (count == 0 || !fem::is_first_order(body.mesh)) return std::nullopt;
  const auto at_all = [&](const MatrixX& part) {
    return put_rows(part, body.support.free_nodes, body.mesh.x.cols());
  };
  const VectorX refined = fem::calc_refined_eigenvalues(
      body.mesh, find_materials(body.mesh, recipe),
      {lambda.head(count), at_all(Phi.leftCols(count)), at_all(body.support.R),
       find_clamped_nodes(body.mesh, recipe)});
  const auto to_hertz = [](double eigenvalue) {
    return std::sqrt(eigenvalue) / (2.0 * std::numbers::pi);
  };
  return MeshLocking{to_hertz(lambda[0]), to_hertz(refined.minCoeff())};
}

}  // namespace limber::flexbody
