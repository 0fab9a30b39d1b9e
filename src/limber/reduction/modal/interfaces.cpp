// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/modal/interfaces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"
#include "limber/common/overloaded.hpp"

namespace limber::flexbody {
namespace {

template <typename Region>
fem::WeightedNodes select_region(const fem::Mesh& mesh, const Region& region) {
  const fem::NearNodes near = fem::find_boundary_nodes(
      mesh, [&](const Vector3& p_M) { return calc_distance(region, p_M); },
      find_tolerance(region, mesh.size().maxCoeff()));
  if (near.nodes.empty())
    throw InputError(fmt::format(
        "{}: no surface node belongs to {}; the nearest is {:.3g} m away. Move "
        "or widen it; look at the length unit.",
        mesh.source, describe(region), near.nearest));
  return fem::weigh_boundary(mesh, near.nodes);
}

fem::WeightedNodes select_nodes(const fem::Mesh& mesh,
                                const NodeSelection& nodes) {
  return std::visit(
      Overloaded{
          [&](const GroupNodes& group) {
            return fem::weigh_group(
                mesh, mesh.groups[fem::find_group(mesh, group.group)]);
          },
          [&](const TaggedNode& node) {
            return fem::weigh_equally(mesh,
                                      {fem::find_tagged_node(mesh, node.tag)});
          },
          [&](const NearestNode& node) {
            return fem::weigh_equally(
                mesh, {fem::find_nearest_node(mesh, node.point)});
          },
          [&](const auto& region) { return select_region(mesh, region); }},
      nodes);
}

fem::WeightedNodes select_nodes(const fem::Mesh& mesh,
                                const InterfaceRequest& request) {
  fem::WeightedNodes selection = select_nodes(mesh, request.nodes);
  if (request.weighting == Weighting::uniform) return selection;
  return fem::weigh_equally(mesh, std::move(selection.nodes));
}

}  // namespace

std::vector<Interface> find_interfaces(const fem::Mesh& mesh,
                                       const Recipe& recipe) {
  std::vector<Interface> interfaces;
  std::set<std::string> names;
  std::vector<std::string> problems;
  for (const InterfaceRequest& request : recipe.interfaces) {
    if (!names.insert(request.name).second)
      throw InputError(
          fmt::format("body '{}': two interfaces are called '{}'. Give each "
                      "its own name.",
                      recipe.name, request.name));
    try {
      fem::WeightedNodes selection = select_nodes(mesh, request);
      InterfaceMotion motion(selection.nodes, selection.weights,
                             selection.moments, mesh.x, mesh.size().maxCoeff());
      interfaces.push_back({request.name, request.static_modes,
                            std::move(selection), std::move(motion)});
    } catch (const InputError& error) {
      problems.push_back(
          fmt::format("interface '{}': {}", request.name, error.what()));
    }
  }
  if (!problems.empty()) throw InputError(problems);
  return interfaces;
}

Matrix6X unit_wrenches(const InterfaceMotion& motion) {
  Matrix6X wrenches = Matrix6X::Identity(6, 3 + motion.rotation_rank());
  wrenches.bottomRightCorner(3, motion.rotation_rank()) =
      motion.rotation_axes();
  return wrenches;
}

MatrixX find_pattern_loads(Eigen::Index rows, const Recipe& recipe,
                           const std::vector<Interface>& interfaces) {
  MatrixX loads(rows, static_cast<Eigen::Index>(recipe.load_patterns.size()));
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

}  // namespace limber::flexbody
