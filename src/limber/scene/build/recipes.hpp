// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/common/errors.hpp"
#include "limber/flexbody/model/recipe.hpp"
#include "limber/scene/robot/robot.hpp"
#include "limber/scene/scenario/scenario.hpp"

namespace limber::scene {

/// Name of the interface that a joint's coupler uses on a flexible link: the
/// one in <attach>, else the one with the joint's name.
[[nodiscard]] std::string find_joint_interface(const FlexibleLink& link,
                                               const std::string& joint);

/// A problem of a reduction; of an interface that a joint of the link needs and
/// that it lacks, with the joint and the interfaces that it has.
[[nodiscard]] std::string name_held_joint(const Robot& robot, int link,
                                          const std::string& problem);

/// Name of the interface for a place on a flexible link: its own, or one
/// derived from the selection ("group:tip"), so that equal links give equal
/// recipes and share one reduction.
[[nodiscard]] std::string find_place_interface(const Place& place);

/// Whether links that are cut are in pieces at a level; others take the whole
/// mesh.
[[nodiscard]] bool takes_pieces(dynamics::Fidelity level);

/// Recipe of a flexible link in this scenario: the link's interfaces, those of
/// its joints and connectors, and those of the loads and probes on it, with the
/// load cases of automatic modes and the nodal fields of the initial
/// deformation.
/// @throws InputError for a force or field file that cannot be read.
[[nodiscard]] flexbody::Recipe make_recipe(const Robot& robot, int link,
                                           const Scenario& scenario);

}  // namespace limber::scene
