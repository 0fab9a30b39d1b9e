// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "flexbody/reduced_body.hpp"
#include "scene/scenario.hpp"

namespace limber::scene {

/// The table of an interface of `body`. @throws InputError naming the nearest.
[[nodiscard]] const flexbody::InterfaceTable& get_table(
    const flexbody::ReducedBody& body, const std::string& interface);

/// The table for a place: its interface, or one row of the basis for a node.
[[nodiscard]] flexbody::InterfaceTable find_table(
    const flexbody::ReducedBody& body, const Place& place);

}  // namespace limber::scene
