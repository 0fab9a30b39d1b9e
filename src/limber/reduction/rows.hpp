// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/fem/mesh/mesh.hpp"
#include "limber/fem/solid/stress_recovery.hpp"
#include "limber/flexbody/modal/reduced_basis.hpp"
#include "limber/flexbody/model/reduced_body.hpp"
#include "limber/reduction/meshed_body.hpp"
#include "limber/reduction/modal/interfaces.hpp"

/// Nodal rows of a body: those that are stored, and its initial deformation.
/// Part of limber_reduction.
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
/// @param second of level `nonlinear`, or none [kg^-1 m^-1]
[[nodiscard]] StressModes make_stress_modes(
    const fem::Mesh& mesh, const Recipe& recipe,
    const std::vector<Interface>& interfaces, const MatrixX& Phi,
    const fem::PairedFields& second);

/// @throws InputError for fields whose number of rows is not that of the body's
/// free degrees of freedom, or with values that are not finite.
void check_initial_fields(const MeshedBody& body, const Recipe& recipe);

/// Projections of the recipe's fields on a basis of the free nodes.
[[nodiscard]] InitialDeformation project_initial_fields(
    const MeshedBody& body, const Recipe& recipe, const ReducedBasis& basis);

}  // namespace limber::flexbody
