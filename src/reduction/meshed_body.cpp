// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/meshed_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "limber/fem/solid/locking.hpp"
#include "limber/reduction/contact_groups.hpp"

namespace limber::flexbody {
fem::TracedMesh read_source(const MeshSource& source,
                            const Progress& progress) {
  report(progress, "reading the mesh", 0.0);
  return fem::read_traced_mesh(
      source.file, {source.size, source.order, source.unit}, progress);
}

fem::Elasticity find_elasticity(MaterialLaw law) {
  return law == MaterialLaw::neo_hookean ? fem::Elasticity::neo_hookean
                                         : fem::Elasticity::st_venant_kirchhoff;
}

std::vector<fem::ElasticMaterial> find_materials(const fem::Mesh& mesh,
                                                 const Recipe& recipe) {
  std::vector<fem::MaterialAssignment> assignments;
  for (const MaterialRegion& region : recipe.materials)
    assignments.push_back(
        {region.group,
         {region.material.youngs_modulus, region.material.poisson_ratio,
          region.material.density}});
  return fem::assign_materials(mesh, assignments);
}

namespace {

void check_basis(const Recipe& recipe) {
  const auto check_count = [&](int count) {
    if (count >= 0) return;
    throw InputError(fmt::format(
        "body '{}': {} eigenmodes; expected 0 or more.", recipe.name, count));
  };
  check_count(recipe.basis.eigenmodes);
  if (recipe.basis.automatic) check_count(recipe.basis.automatic->candidates);
}

/// Checks all names in the recipe before assembling, so that errors are found
/// before long work. Fills `M_s`.
Support assemble_support(const fem::Mesh& mesh, const Recipe& recipe,
                         const std::vector<Interface>& interfaces,
                         fem::SparseMatrix& M_s, const Progress& progress) {
  const std::vector<fem::ElasticMaterial> materials =
      find_materials(mesh, recipe);
  static_cast<void>(find_pattern_loads(mesh, recipe, interfaces));
  check_basis(recipe);
  for (const auto* names : {&recipe.clamped_groups, &recipe.rows.groups})
    for (const std::string& name : *names)
      static_cast<void>(fem::find_group(mesh, name));
  static_cast<void>(
      find_contact_groups(mesh, recipe.contact_groups, materials));
  fem::StructuralMatrices matrices = fem::assemble(mesh, materials, progress);
  M_s = matrices.M_s;
  return make_support(mesh, recipe, std::move(matrices));
}

}  // namespace

MeshedBody::MeshedBody(const Recipe& recipe, const Progress& progress)
    : MeshedBody(recipe,
                 std::make_shared<const fem::TracedMesh>(
                     read_source(recipe.mesh, progress)),
                 progress) {}

MeshedBody::MeshedBody(const Recipe& recipe,
                       std::shared_ptr<const fem::TracedMesh> traced,
                       const Progress& progress)
    : made(std::move(traced)),
      mesh(made->mesh),
      interfaces(find_interfaces(mesh, recipe)),
      support(assemble_support(mesh, recipe, interfaces, M_s, progress)),
      inverse(support.matrices, support.R,
              mesh.x(Eigen::all, support.free_nodes), progress) {}

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
