// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/flexbody/model/recipe.hpp"
#include "limber/flexbody/model/reduced_body.hpp"
#include "limber/scene/scenario/scenario.hpp"

/// Initial deformation of flexible links ([initial.links]).
namespace limber::scene {

/// The start of a link, or null if the scenario gives none.
[[nodiscard]] const LinkStart* find_start(const Scenario& scenario,
                                          const std::string& link);

/// Adds the nodal fields of a start to a recipe, which projects them.
/// @throws InputError for a file that cannot be read.
void add_initial_fields(const LinkStart& start, flexbody::Recipe& recipe);

/// For a body from a file, which may not have all rows.
/// @throws InputError unless it was reduced with the fields of `start`.
void check_saved_fields(const LinkStart& start,
                        const flexbody::ReducedBody& body);

/// The parts of the fields of `start` outside the body's modes.
[[nodiscard]] std::vector<std::string> describe_losses(
    const LinkStart& start, const flexbody::ReducedBody& body);

struct ModalStart {
  VectorX eta;     ///< m [kg^1/2 m]
  VectorX etadot;  ///< m [kg^1/2 m/s]
};

/// Modal coordinates of a start; missing ones are zero.
/// @throws InputError for more of them than the body has modes.
[[nodiscard]] ModalStart find_modal_start(const LinkStart& start,
                                          const flexbody::ReducedBody& body);

}  // namespace limber::scene
