// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

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
  std::optional<flexbody::InterfaceTable> table;  ///< of a flexible link
  std::optional<flexbody::NodeSet> nodes;         ///< if it is unreduced too
};

/// An interface of a flexible link's body. @throws InputError naming the
/// nearest.
[[nodiscard]] Anchor find_anchor(const BodyPlan& plan,
                                 const std::string& interface);

/// A place's interface, or one row of the basis for a single node.
[[nodiscard]] Anchor find_anchor(const BodyPlan& plan, const Place& place);

}  // namespace limber::scene
