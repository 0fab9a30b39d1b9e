// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/reduction/matrices/matrix_system.hpp"
#include "limber/reduction/modal/interfaces.hpp"

/// Node sets of a model given by matrices. Part of limber_reduction.
namespace limber::flexbody {

/// Sorted nodes of a set, or of "node:TAG". @throws InputError, naming the
/// nearest.
[[nodiscard]] std::vector<int> find_matrix_nodes(const MatrixSystem& system,
                                                 const std::string& set);

/// The recipe's interfaces. A set of one node with rotations is a frame by
/// itself; of several nodes, all with the same weight, least squares of their
/// translations. Fields have six rows a node (field_row).
/// @throws InputError as find_interfaces, and for nodes that cannot move
[[nodiscard]] std::vector<Interface> find_interfaces(const MatrixSystem& system,
                                                     const Recipe& recipe);

}  // namespace limber::flexbody
