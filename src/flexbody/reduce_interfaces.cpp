// SPDX-License-Identifier: BSD-3-Clause
#include "flexbody/reduce_interfaces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "common/errors.hpp"
#include "common/names.hpp"

namespace limber::flexbody {
namespace {

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

}  // namespace

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

Matrix6X unit_wrenches(const InterfaceMotion& motion) {
  Matrix6X wrenches = Matrix6X::Identity(6, 3 + motion.rotation_rank());
  wrenches.bottomRightCorner(3, motion.rotation_rank()) =
      motion.rotation_axes();
  return wrenches;
}

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

}  // namespace limber::flexbody
