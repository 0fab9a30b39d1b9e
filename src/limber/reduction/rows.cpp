// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "limber/common/errors.hpp"
#include "limber/common/material/anisotropy.hpp"
#include "limber/reduction/modal/kept_rows.hpp"
#include "limber/reduction/modal/support.hpp"

namespace limber::flexbody {
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

namespace {

std::vector<std::size_t> tags_of(const fem::Mesh& mesh,
                                 const std::vector<int>& nodes) {
  std::vector<std::size_t> tags;
  for (const int node : nodes)
    tags.push_back(mesh.tags[static_cast<std::size_t>(node)]);
  return tags;
}

// Index of each node in `kept`, which has all of them.
std::vector<std::size_t> find_rows(const std::vector<int>& kept,
                                   const std::vector<int>& nodes) {
  std::vector<std::size_t> rows;
  for (const int node : nodes) {
    rows.push_back(find_kept_row(kept, node).value());
  }
  return rows;
}

}  // namespace

void keep_rows(const fem::Mesh& mesh, const Recipe& recipe,
               const std::vector<Interface>& interfaces, const MatrixX& Phi,
               ReducedBody& body) {
  const std::vector<int> kept = choose_rows(mesh, recipe, interfaces);
  body.rows.tags = tags_of(mesh, kept);
  body.rows.x_B = Matrix3X(mesh.x(Eigen::all, kept)).colwise() - body.p_MoBcm_M;
  body.rows.Phi_B = take_rows(Phi, kept);
  body.triangles = find_kept_elements(fem::boundary_triangles(mesh), kept);
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

namespace {

// 9 x points, zero where a material has none; 9 x 0 if no material has any.
MatrixX find_material_axes(const fem::Mesh& mesh, const fem::NodalStress& nodal,
                           const std::vector<std::size_t>& points) {
  const bool have_axes =
      std::any_of(nodal.constants.begin(), nodal.constants.end(),
                  [](const auto& c) { return c.anisotropy.has_value(); });
  if (!have_axes) return MatrixX(9, 0);
  MatrixX axes = MatrixX::Zero(9, std::ssize(points));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t point = points[i];
    const auto material = static_cast<std::size_t>(nodal.materials[point]);
    if (!nodal.constants[material].anisotropy) continue;
    const Matrix3 at =
        find_axes(nodal.constants[material], mesh.x.col(nodal.nodes[point]));
    axes.col(static_cast<Eigen::Index>(i)) = at.reshaped();
  }
  return axes;
}

}  // namespace

StressModes make_stress_modes(const fem::Mesh& mesh, const Recipe& recipe,
                              const std::vector<Interface>& interfaces,
                              const MatrixX& Phi,
                              const fem::PairedFields& second) {
  const fem::NodalStress nodal =
      fem::recover_stress(mesh, find_materials(mesh, recipe), Phi, second);
  const Eigen::Index columns = nodal.stress.rows() / 6;
  const std::vector<int> kept = choose_rows(mesh, recipe, interfaces);
  std::vector<std::size_t> points;  // of the kept nodes
  StressModes modes;
  for (std::size_t i = 0; i < nodal.nodes.size(); ++i) {
    const int node = nodal.nodes[i];
    if (!std::binary_search(kept.begin(), kept.end(), node)) continue;
    points.push_back(i);
    modes.rows.push_back(find_rows(kept, {node}).front());
    modes.materials.push_back(nodal.materials[i]);
    modes.on_surface.push_back(std::binary_search(mesh.boundary_nodes.begin(),
                                                  mesh.boundary_nodes.end(),
                                                  node)
                                   ? 1
                                   : 0);
  }
  modes.Sigma_B.resize(6 * std::ssize(points), columns);
  for (std::size_t i = 0; i < points.size(); ++i) {
    modes.Sigma_B.middleRows<6>(6 * static_cast<Eigen::Index>(i)) =
        nodal.stress.col(static_cast<Eigen::Index>(points[i]))
            .reshaped(6, columns);
  }
  modes.axes = find_material_axes(mesh, nodal, points);
  modes.averaging = nodal.averaging;
  modes.constants.resize(2, static_cast<Eigen::Index>(nodal.constants.size()));
  for (std::size_t i = 0; i < nodal.constants.size(); ++i) {
    modes.constants.col(static_cast<Eigen::Index>(i))
        << nodal.constants[i].youngs_modulus,
        nodal.constants[i].poisson_ratio;
  }
  for (const Interface& interface : interfaces) {
    modes.interface_rows.push_back(find_rows(kept, interface.selection.nodes));
  }
  return modes;
}

void check_initial_fields(const MeshedBody& body, const Recipe& recipe) {
  const Eigen::Index rows = body.support.matrices.dof_count();
  std::vector<std::string> problems;
  for (const auto* field :
       {&recipe.initial_displacement, &recipe.initial_velocity}) {
    if (field->values.size() == 0) continue;
    if (field->values.size() != rows)
      problems.push_back(fmt::format(
          "{}: {} rows; expected {}, three for each of the {} nodes that are "
          "not clamped",
          field->name, field->values.size(), rows, rows / 3));
    if (!field->values.allFinite())
      problems.push_back(fmt::format(
          "{}: it contains values that are not finite", field->name));
  }
  if (!problems.empty()) throw InputError(problems);
}

InitialDeformation project_initial_fields(const MeshedBody& body,
                                          const Recipe& recipe,
                                          const ReducedBasis& basis) {
  const auto project =
      [&](const NodalField& field) -> std::optional<ProjectedField> {
    if (field.values.size() == 0) return std::nullopt;
    return project_field(field.values, basis.Phi, body.support.matrices.M_s,
                         body.support.R);
  };
  return {project(recipe.initial_displacement),
          project(recipe.initial_velocity)};
}

}  // namespace limber::flexbody
