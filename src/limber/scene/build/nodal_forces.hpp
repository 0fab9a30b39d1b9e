// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limber/flexbody/model/recipe.hpp"
#include "limber/flexbody/model/reduced_body.hpp"
#include "limber/scene/text/force_file.hpp"

namespace limber::scene {

/// A force file's rows at the rows of a body that has all of them, 3n x T [N]:
/// nodes of clamped groups have no rows in the file and get zeros.
/// @throws InputError naming `file` if the body does not have every row or the
/// file's number of rows is not that of the body's free degrees of freedom.
[[nodiscard]] MatrixX spread_over_nodes(
    const flexbody::ReducedBody& body,
    const std::vector<std::string>& clamped_groups, const ForceFile& forces,
    const std::filesystem::path& file);

/// A force file as load cases for a reduction, which checks its rows.
/// @throws InputError as read_force_file.
[[nodiscard]] flexbody::NodalForces read_load_cases(
    const std::filesystem::path& file);

}  // namespace limber::scene
