// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/nodal_forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "limber/common/errors.hpp"

namespace limber::scene {
namespace {

std::set<std::size_t> find_clamped(const flexbody::ReducedBody& body,
                                   const std::vector<std::string>& names) {
  std::set<std::size_t> tags;
  for (const flexbody::NodeGroup& group : body.groups) {
    if (std::find(names.begin(), names.end(), group.name) != names.end()) {
      tags.insert(group.tags.begin(), group.tags.end());
    }
  }
  return tags;
}

}  // namespace

MatrixX spread_over_nodes(const flexbody::ReducedBody& body,
                          const std::vector<std::string>& clamped_groups,
                          const ForceFile& forces,
                          const std::filesystem::path& file) {
  const std::size_t nodes = body.rows.tags.size();
  if (nodes != body.mesh_nodes) {
    throw InputError(fmt::format(
        "{}: nodal forces need every node, but the reduced body keeps {} of "
        "{}; reduce it with rows 'all'",
        file.string(), nodes, body.mesh_nodes));
  }
  const std::set<std::size_t> clamped = find_clamped(body, clamped_groups);
  const std::size_t free = nodes - clamped.size();
  if (static_cast<std::size_t>(forces.forces.rows()) != 3 * free) {
    throw InputError(fmt::format(
        "{}: {} rows of forces; expected {}, three for each of the {} nodes "
        "that are not clamped",
        file.string(), forces.forces.rows(), 3 * free, free));
  }
  MatrixX spread =
      MatrixX::Zero(3 * static_cast<Eigen::Index>(nodes), forces.forces.cols());
  Eigen::Index next = 0;
  for (std::size_t i = 0; i < nodes; ++i) {
    if (clamped.contains(body.rows.tags[i])) continue;
    spread.middleRows<3>(3 * static_cast<Eigen::Index>(i)) =
        forces.forces.middleRows<3>(3 * next++);
  }
  return spread;
}

flexbody::NodalForces read_load_cases(const std::filesystem::path& file) {
  ForceFile forces = read_force_file(file);
  return {file.string(), std::move(forces.times), std::move(forces.forces)};
}

}  // namespace limber::scene
