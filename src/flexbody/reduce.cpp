// SPDX-License-Identifier: BSD-3-Clause
#include "flexbody/reduce.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"
#include "fem/assembly.hpp"
#include "fem/eigenmodes.hpp"
#include "fem/mesh_reader.hpp"
#include "flexbody/reduce_interfaces.hpp"
#include "flexbody/reduce_rows.hpp"
#include "flexbody/reduce_support.hpp"
#include "flexbody/reduced_basis.hpp"
#include "flexbody/shape_integrals.hpp"

namespace limber::flexbody {
namespace {

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

/// Static answers to unit loads, on the whole mesh.
struct StaticModes {
  MatrixX vectors;                   ///< those that enter the basis
  std::vector<Matrix6> flexibility;  ///< per interface
};

StaticModes find_static_modes(const fem::Mesh& mesh, const Recipe& recipe,
                              const std::vector<Interface>& interfaces,
                              const Support& support,
                              const fem::ElasticInverse& inverse) {
  const auto solve = [&](const MatrixX& loads) {
    return put_rows(inverse.solve(take_rows(loads, support.free_nodes)),
                    support.free_nodes, mesh.x.cols());
  };
  StaticModes modes;
  modes.vectors.resize(3 * mesh.x.cols(), 0);
  const auto append = [&](const MatrixX& answers) {
    MatrixX joined(answers.rows(), modes.vectors.cols() + answers.cols());
    joined << modes.vectors, answers;
    modes.vectors = std::move(joined);
  };
  for (const Interface& interface : interfaces) {
    const Matrix6X wrenches = unit_wrenches(interface.motion);
    const MatrixX answers = solve(interface.motion.spread(wrenches));
    const Matrix6 flexibility =
        interface.motion.apply(answers) * wrenches.transpose();
    modes.flexibility.emplace_back(0.5 *
                                   (flexibility + flexibility.transpose()));
    if (recipe.basis.interface_modes && interface.static_modes) append(answers);
  }
  const MatrixX loads = find_pattern_loads(mesh, recipe, interfaces);
  if (recipe.basis.load_modes && loads.cols() > 0) append(solve(loads));
  return modes;
}

void add_tables(const std::vector<Interface>& interfaces,
                const StaticModes& modes, const MatrixX& Phi,
                ReducedBody& body) {
  for (std::size_t i = 0; i < interfaces.size(); ++i) {
    const InterfaceMotion& motion = interfaces[i].motion;
    const Matrix6X table = motion.apply(Phi);
    body.interfaces.push_back({interfaces[i].name,
                               motion.mean_point() - body.p_MoBcm_M,
                               table.topRows<3>(), table.bottomRows<3>(),
                               motion.rotation_rank(), modes.flexibility[i]});
  }
}

ReducedBasis find_basis(const Recipe& recipe, const Support& support,
                        const fem::Eigenmodes& eigenmodes,
                        const StaticModes& modes) {
  MatrixX vectors(support.matrices.dof_count(),
                  eigenmodes.Phi.cols() + modes.vectors.cols());
  vectors << eigenmodes.Phi, take_rows(modes.vectors, support.free_nodes);
  return make_reduced_basis(vectors, support.matrices.M_s, support.matrices.K,
                            support.R, recipe.basis.drop_tolerance);
}

}  // namespace

ReducedBody reduce(const Recipe& recipe, const Progress& progress) {
  report(progress, "reading the mesh", 0.0);
  const fem::Mesh mesh =
      fem::read_mesh(recipe.mesh.file,
                     {recipe.mesh.size, recipe.mesh.order, recipe.mesh.unit});
  const std::vector<fem::ElasticMaterial> materials =
      find_materials(mesh, recipe);
  // Everything a user may have misspelt is looked at before the long work.
  const std::vector<Interface> interfaces = find_interfaces(mesh, recipe);
  static_cast<void>(find_pattern_loads(mesh, recipe, interfaces));
  if (recipe.basis.eigenmodes < 0)
    throw InputError(
        fmt::format("body '{}': {} eigenmodes; expected 0 or more.",
                    recipe.name, recipe.basis.eigenmodes));
  for (const auto* names : {&recipe.clamped_groups, &recipe.rows.groups})
    for (const std::string& name : *names)
      static_cast<void>(fem::find_group(mesh, name));

  fem::StructuralMatrices matrices = fem::assemble(mesh, materials, progress);
  const fem::SparseMatrix M_s = matrices.M_s;
  const Support support = make_support(mesh, recipe, std::move(matrices));
  const fem::ElasticInverse inverse(support.matrices, support.R,
                                    mesh.x(Eigen::all, support.free_nodes),
                                    progress);
  const fem::Eigenmodes eigenmodes =
      fem::find_eigenmodes(inverse, recipe.basis.eigenmodes, progress);
  report(progress, "static-deformation modes", 0.0);
  const StaticModes modes =
      find_static_modes(mesh, recipe, interfaces, support, inverse);
  const ReducedBasis basis = find_basis(recipe, support, eigenmodes, modes);
  const MatrixX Phi = put_rows(basis.Phi, support.free_nodes, mesh.x.cols());

  const fem::MassProperties inertia = fem::calc_mass_properties(M_s, mesh.x);
  ReducedBody body;
  body.name = recipe.name;
  body.clamped = support.is_clamped;
  body.mass = inertia.mass;
  body.p_MoBcm_M = inertia.center;
  body.size = mesh.size();
  body.integrals =
      calc_shape_integrals(M_s, mesh.x.colwise() - inertia.center, Phi);
  body.lambda = basis.lambda;
  body.mesh_nodes = mesh.node_count();
  body.mesh_elements = mesh.element_count();
  body.mesh_boundary_nodes = mesh.boundary_nodes.size();
  keep_rows(mesh, recipe, interfaces, Phi, body);
  add_tables(interfaces, modes, Phi, body);
  report(progress, "reduced", 1.0);
  return body;
}

}  // namespace limber::flexbody
