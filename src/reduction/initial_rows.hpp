// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "flexbody/initial_deformation.hpp"
#include "flexbody/reduce_meshed_body.hpp"
#include "flexbody/reduced_basis.hpp"

/// The deformation that a body starts with. Part of limber_reduction.
namespace limber::flexbody {

/// @throws InputError for fields of another number of rows than the body has
/// free degrees of freedom, or with values that are not finite.
void check_initial_fields(const MeshedBody& body, const Recipe& recipe);

/// Projections of the recipe's fields on a basis of the free nodes.
[[nodiscard]] InitialDeformation project_initial_fields(
    const MeshedBody& body, const Recipe& recipe, const ReducedBasis& basis);

}  // namespace limber::flexbody
