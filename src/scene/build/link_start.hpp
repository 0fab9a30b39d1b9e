// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "flexbody/recipe.hpp"
#include "flexbody/reduced_body.hpp"
#include "scene/scenario.hpp"

/// The deformation that flexible links start with ([initial.links]).
namespace limber::scene {

/// The start of a link, or null if the scenario gives none.
[[nodiscard]] const LinkStart* find_start(const Scenario& scenario,
                                          const std::string& link);

/// Puts the nodal fields of a start into a recipe, which projects them.
/// @throws InputError for a file that cannot be read.
void add_initial_fields(const LinkStart& start, flexbody::Recipe& recipe);

/// For a body from a file, whose rows may be gone.
/// @throws InputError unless it was reduced with the fields that `start` names.
void check_saved_fields(const LinkStart& start,
                        const flexbody::ReducedBody& body);

/// What the body's modes leave out of the fields that `start` names.
[[nodiscard]] std::vector<std::string> describe_losses(
    const LinkStart& start, const flexbody::ReducedBody& body);

struct ModalStart {
  VectorX eta;     ///< m [kg^1/2 m]
  VectorX etadot;  ///< m [kg^1/2 m/s]
};

/// Modal coordinates of a start; those not given are zero.
/// @throws InputError for more of them than the body has modes.
[[nodiscard]] ModalStart find_modal_start(const LinkStart& start,
                                          const flexbody::ReducedBody& body);

}  // namespace limber::scene
