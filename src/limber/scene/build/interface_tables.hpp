// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>

#include "limber/flexbody/model/reduced_body.hpp"
#include "limber/scene/build/body_plan.hpp"
#include "limber/scene/scenario/scenario.hpp"

/// Interfaces for couplers, loads and probes on a flexible link.
namespace limber::scene {

/// The table of an interface of `body`. @throws InputError naming the nearest.
[[nodiscard]] const flexbody::InterfaceTable& get_table(
    const flexbody::ReducedBody& body, const std::string& interface);

/// A place on a link; empty on a rigid one.
struct Anchor {
  int piece = 0;                                  ///< of the link's bodies
  std::optional<flexbody::InterfaceTable> table;  ///< of a flexible link
  std::optional<flexbody::NodeSet> nodes;         ///< if it is unreduced too
};

/// An interface of a flexible link, on the piece that has it. @throws
/// InputError naming the nearest.
[[nodiscard]] Anchor find_anchor(std::span<const BodyPlan> pieces,
                                 const std::string& interface);

/// A place's interface, or one row of the basis for a single node.
[[nodiscard]] Anchor find_anchor(std::span<const BodyPlan> pieces,
                                 const Place& place);

/// The piece that has a place: an interface or a single node.
[[nodiscard]] int find_piece(std::span<const BodyPlan> pieces,
                             const Place& place);

}  // namespace limber::scene
