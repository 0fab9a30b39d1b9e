// SPDX-License-Identifier: BSD-3-Clause
#include "flexbody/reduce.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <set>

#include "common/errors.hpp"
#include "common/names.hpp"
#include "fem/assembly.hpp"
#include "fem/eigenmodes.hpp"
#include "fem/mesh_reader.hpp"
#include "fem/node_weights.hpp"
#include "flexbody/interface_motion.hpp"
#include "flexbody/reduced_basis.hpp"
#include "flexbody/shape_integrals.hpp"

namespace limber::flexbody {
namespace {

/// An interface request, tied to the mesh.
struct Interface {
  std::string name;
  bool static_modes = true;
  fem::WeightedNodes selection;
  InterfaceMotion motion;
};

/// Which nodes move, and the body's matrices on them.
struct Support {
  bool is_clamped = false;
  std::vector<int> free_nodes;
  fem::StructuralMatrices matrices;
  MatrixX R;  ///< rigid modes of the free nodes; no columns if clamped
};

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

/// @throws InputError if the clamped nodes leave the body a rigid motion.
void check_clamp(const fem::Mesh& mesh, const std::set<int>& clamped) {
  const std::vector<int> nodes(clamped.begin(), clamped.end());
  const Matrix3X x = mesh.x(Eigen::all, nodes);
  const Matrix3X d = x.colwise() - Vector3(x.rowwise().mean());
  const Eigen::JacobiSVD<MatrixX> svd(MatrixX(d * d.transpose()));
  constexpr double kLine = 1e-12;  // squared, of the body's size
  if (svd.singularValues()[1] > kLine * mesh.size().squaredNorm()) return;
  throw InputError(fmt::format(
      "{}: the clamped groups hold {} nodes on one line, about which the body "
      "can still turn. Clamp a surface, or hold the body by couplers.",
      mesh.source, clamped.size()));
}

Support make_support(const fem::Mesh& mesh, const Recipe& recipe,
                     fem::StructuralMatrices matrices) {
  std::set<int> clamped;
  for (const std::string& name : recipe.clamped_groups) {
    const fem::PhysicalGroup& group = mesh.groups[fem::find_group(mesh, name)];
    clamped.insert(group.nodes.begin(), group.nodes.end());
  }
  Support support;
  support.is_clamped = !clamped.empty();
  if (support.is_clamped) check_clamp(mesh, clamped);
  for (int node = 0; node < static_cast<int>(mesh.node_count()); ++node)
    if (!clamped.contains(node)) support.free_nodes.push_back(node);
  if (!support.is_clamped) {
    support.R = fem::make_rigid_modes(matrices.M_s, mesh.x);
    support.matrices = std::move(matrices);
    return support;
  }
  if (support.free_nodes.empty())
    throw InputError(fmt::format("{}: every node is clamped; nothing can move.",
                                 mesh.source));
  support.matrices = fem::restrict_to(matrices, support.free_nodes);
  support.R.resize(support.matrices.dof_count(), 0);
  return support;
}

fem::WeightedNodes select_nodes(const fem::Mesh& mesh,
                                const InterfaceRequest& request) {
  const auto weigh_one = [](int node) { return fem::weigh_equally({node}); };
  if (const auto* group = std::get_if<GroupNodes>(&request.nodes))
    return fem::weigh_group(mesh,
                            mesh.groups[fem::find_group(mesh, group->group)]);
  if (const auto* node = std::get_if<TaggedNode>(&request.nodes))
    return weigh_one(fem::find_tagged_node(mesh, node->tag));
  if (const auto* nearest = std::get_if<NearestNode>(&request.nodes))
    return weigh_one(fem::find_nearest_node(mesh, nearest->point));
  const auto& box = std::get<BoxNodes>(request.nodes);
  const std::vector<int> nodes =
      fem::find_boundary_nodes_in_box(mesh, box.lower, box.upper);
  if (nodes.empty())
    throw InputError(fmt::format(
        "{}: interface '{}': no surface node lies in the box from ({:g}, {:g}, "
        "{:g}) to ({:g}, {:g}, {:g}) m. Widen it; look at the length unit.",
        mesh.source, request.name, box.lower[0], box.lower[1], box.lower[2],
        box.upper[0], box.upper[1], box.upper[2]));
  return fem::weigh_boundary(mesh, nodes);
}

std::vector<Interface> find_interfaces(const fem::Mesh& mesh,
                                       const Recipe& recipe) {
  std::vector<Interface> interfaces;
  std::set<std::string> names;
  for (const InterfaceRequest& request : recipe.interfaces) {
    if (!names.insert(request.name).second)
      throw InputError(
          fmt::format("body '{}': two interfaces are called '{}'. Give each "
                      "its own name.",
                      recipe.name, request.name));
    fem::WeightedNodes selection = select_nodes(mesh, request);
    if (request.weighting == Weighting::equal)
      selection = fem::weigh_equally(selection.nodes);
    InterfaceMotion motion(selection.nodes, selection.weights, mesh.x,
                           mesh.size().maxCoeff());
    interfaces.push_back({request.name, request.static_modes,
                          std::move(selection), std::move(motion)});
  }
  return interfaces;
}

/// Forces and moments that the interface can carry: 3 + rotation rank.
Matrix6X unit_wrenches(const InterfaceMotion& motion) {
  Matrix6X wrenches = Matrix6X::Identity(6, 3 + motion.rotation_rank());
  wrenches.bottomRightCorner(3, motion.rotation_rank()) =
      motion.rotation_axes();
  return wrenches;
}

MatrixX take_rows(const MatrixX& full, const std::vector<int>& nodes) {
  MatrixX part(3 * static_cast<Eigen::Index>(nodes.size()), full.cols());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    part.middleRows<3>(3 * static_cast<Eigen::Index>(i)) =
        full.middleRows<3>(3 * nodes[i]);
  return part;
}

MatrixX put_rows(const MatrixX& part, const std::vector<int>& nodes,
                 Eigen::Index all_nodes) {
  MatrixX full = MatrixX::Zero(3 * all_nodes, part.cols());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    full.middleRows<3>(3 * nodes[i]) =
        part.middleRows<3>(3 * static_cast<Eigen::Index>(i));
  return full;
}

/// Columns that `loads` would have on the whole mesh.
MatrixX find_pattern_loads(const fem::Mesh& mesh, const Recipe& recipe,
                           const std::vector<Interface>& interfaces) {
  MatrixX loads(3 * static_cast<Eigen::Index>(mesh.node_count()),
                static_cast<Eigen::Index>(recipe.load_patterns.size()));
  std::vector<std::string> known;
  for (const Interface& interface : interfaces) known.push_back(interface.name);
  for (std::size_t i = 0; i < recipe.load_patterns.size(); ++i) {
    const LoadPattern& pattern = recipe.load_patterns[i];
    const auto found = std::find(known.begin(), known.end(), pattern.interface);
    if (found == known.end())
      throw InputError(
          fmt::format("body '{}', load pattern: {}", recipe.name,
                      describe_unknown("interface", pattern.interface, known)));
    Matrix6X wrench(6, 1);
    wrench << pattern.force, pattern.moment;
    loads.col(static_cast<Eigen::Index>(i)) =
        interfaces[static_cast<std::size_t>(found - known.begin())]
            .motion.spread(wrench);
  }
  return loads;
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

/// Nodes whose rows are kept, sorted.
std::vector<int> choose_rows(const fem::Mesh& mesh, const Recipe& recipe,
                             const std::vector<Interface>& interfaces) {
  using Extent = KeptRows::Extent;
  std::set<int> kept;
  const auto keep = [&](const std::vector<int>& nodes) {
    kept.insert(nodes.begin(), nodes.end());
  };
  if (recipe.rows.extent == Extent::all)
    for (int n = 0; n < static_cast<int>(mesh.node_count()); ++n)
      kept.insert(kept.end(), n);
  if (recipe.rows.extent == Extent::boundary) {
    keep(mesh.boundary_nodes);
    for (const fem::PhysicalGroup& group : mesh.groups)
      if (group.dimension < 3) keep(group.nodes);
  }
  for (const std::string& name : recipe.rows.groups)
    keep(mesh.groups[fem::find_group(mesh, name)].nodes);
  for (const Interface& interface : interfaces) keep(interface.selection.nodes);
  return {kept.begin(), kept.end()};
}

std::vector<std::size_t> tags_of(const fem::Mesh& mesh,
                                 const std::vector<int>& nodes) {
  std::vector<std::size_t> tags;
  for (const int node : nodes)
    tags.push_back(mesh.tags[static_cast<std::size_t>(node)]);
  return tags;
}

std::vector<std::array<std::size_t, 3>> kept_triangles(
    const fem::Mesh& mesh, const std::vector<int>& kept) {
  std::vector<std::array<std::size_t, 3>> triangles;
  for (const std::array<int, 3>& nodes : fem::boundary_triangles(mesh)) {
    std::array<std::size_t, 3> rows{};
    bool is_kept = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto found = std::lower_bound(kept.begin(), kept.end(), nodes[i]);
      is_kept = is_kept && found != kept.end() && *found == nodes[i];
      rows[i] = static_cast<std::size_t>(found - kept.begin());
    }
    if (is_kept) triangles.push_back(rows);
  }
  return triangles;
}

void keep_rows(const fem::Mesh& mesh, const Recipe& recipe,
               const std::vector<Interface>& interfaces, const MatrixX& Phi,
               ReducedBody& body) {
  const std::vector<int> kept = choose_rows(mesh, recipe, interfaces);
  body.rows.tags = tags_of(mesh, kept);
  body.rows.x_B = Matrix3X(mesh.x(Eigen::all, kept)).colwise() - body.p_MoBcm_M;
  body.rows.Phi_B = take_rows(Phi, kept);
  body.triangles = kept_triangles(mesh, kept);
  for (const fem::PhysicalGroup& group : mesh.groups) {
    const auto is_kept = [&](int node) {
      return std::binary_search(kept.begin(), kept.end(), node);
    };
    if (!std::all_of(group.nodes.begin(), group.nodes.end(), is_kept)) continue;
    const fem::WeightedNodes weighted = fem::weigh_group(mesh, group);
    body.groups.push_back({group.name, group.dimension,
                           tags_of(mesh, weighted.nodes), weighted.weights});
  }
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
