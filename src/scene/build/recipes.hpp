// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/errors.hpp"
#include "flexbody/recipe.hpp"
#include "scene/robot.hpp"
#include "scene/scenario.hpp"

namespace limber::scene {

/// Name of the interface that a joint's coupler uses on a flexible link: the
/// one that <attach> says, else the one called like the joint.
[[nodiscard]] std::string find_joint_interface(const FlexibleLink& link,
                                               const std::string& joint);

/// Name of the interface for a place on a flexible link: its own, or one made
/// from what is selected ("group:tip"), so that equal links make equal
/// recipes and share one reduction.
[[nodiscard]] std::string find_place_interface(const Place& place);

/// What to ask of the reduction of a flexible link in this scenario: the
/// link's own interfaces, those of its joints and connectors, and those of
/// the loads and probes on it. It holds the load cases
/// of automatic modes and the nodal fields that the link starts with.
/// @throws InputError for a force or field file that cannot be read.
[[nodiscard]] flexbody::Recipe make_recipe(const Robot& robot, int link,
                                           const Scenario& scenario);

}  // namespace limber::scene
