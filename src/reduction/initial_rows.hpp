// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/flexbody/modal/reduced_basis.hpp"
#include "limber/flexbody/model/initial_deformation.hpp"
#include "limber/reduction/meshed_body.hpp"

/// Initial deformation of a body. Part of limber_reduction.
namespace limber::flexbody {

/// @throws InputError for fields whose number of rows is not that of the body's
/// free degrees of freedom, or with values that are not finite.
void check_initial_fields(const MeshedBody& body, const Recipe& recipe);

/// Projections of the recipe's fields on a basis of the free nodes.
[[nodiscard]] InitialDeformation project_initial_fields(
    const MeshedBody& body, const Recipe& recipe, const ReducedBasis& basis);

}  // namespace limber::flexbody
