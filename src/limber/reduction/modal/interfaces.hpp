// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/fem/mesh/mesh.hpp"
#include "limber/fem/mesh/node_weights.hpp"
#include "limber/flexbody/model/interface_motion.hpp"
#include "limber/flexbody/model/recipe.hpp"

/// A recipe's interfaces and the loads on them, on its mesh. Part of
/// limber_reduction.
namespace limber::flexbody {

/// An interface request resolved on the mesh.
struct Interface {
  std::string name;
  bool static_modes = true;
  fem::WeightedNodes selection;
  InterfaceMotion motion;
};

/// @throws InputError for a name given twice, and for every selection without
/// nodes: the interface, the selection, how far its nearest node is.
[[nodiscard]] std::vector<Interface> find_interfaces(const fem::Mesh& mesh,
                                                     const Recipe& recipe);

/// Unit forces and moments that the interface can carry: 3 + rotation rank.
[[nodiscard]] Matrix6X unit_wrenches(const InterfaceMotion& motion);

/// Nodal forces of each load pattern, rows x patterns [N].
/// @param rows of fields of all nodes
/// @throws InputError for an interface that does not exist.
[[nodiscard]] MatrixX find_pattern_loads(
    Eigen::Index rows, const Recipe& recipe,
    const std::vector<Interface>& interfaces);

}  // namespace limber::flexbody
