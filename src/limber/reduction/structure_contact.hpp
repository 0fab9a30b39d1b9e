// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "limber/flexbody/model/recipe.hpp"
#include "limber/reduction/matrices/reduce_matrices.hpp"

/// Part of limber_reduction.
namespace limber::flexbody {

/// Makes the surfaces of the recipe's contact groups of a structure; none
/// without groups. Groups are "skin", the whole surface, and sets: the faces
/// all of whose nodes are, or move with, nodes of the set; "SET.top" and
/// "SET.bottom" are those on one side of shells, along their normal and against
/// it.
/// @throws InputError for a set that does not exist or has no face, one named
/// twice, and several elasticities in a group
[[nodiscard]] SurfaceMaker make_structure_surfaces(
    const std::shared_ptr<const MatrixPart>& part, const Recipe& recipe,
    const Progress& progress);

}  // namespace limber::flexbody
