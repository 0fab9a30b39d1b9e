// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/fem/mesh/mesh.hpp"
#include "limber/flexbody/model/reduced_body.hpp"
#include "limber/reduction/interfaces.hpp"

namespace limber::flexbody {

/// Nodes whose rows are stored, sorted.
/// @throws InputError for a group that does not exist.
[[nodiscard]] std::vector<int> choose_rows(
    const fem::Mesh& mesh, const Recipe& recipe,
    const std::vector<Interface>& interfaces);

/// Fills `rows`, `triangles` and `groups` of a body whose `p_MoBcm_M` is set.
/// @param Phi 3N x m, all rows [kg^-1/2]
/// @throws InputError for a group that does not exist.
void keep_rows(const fem::Mesh& mesh, const Recipe& recipe,
               const std::vector<Interface>& interfaces, const MatrixX& Phi,
               ReducedBody& body);

/// Stress modes at the rows that keep_rows() stores.
/// @param Phi 3N x m, all rows [kg^-1/2]
[[nodiscard]] StressModes make_stress_modes(
    const fem::Mesh& mesh, const Recipe& recipe,
    const std::vector<Interface>& interfaces, const MatrixX& Phi);

}  // namespace limber::flexbody
