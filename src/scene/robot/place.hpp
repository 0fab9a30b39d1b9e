// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "common/types.hpp"
#include "flexbody/recipe.hpp"

namespace limber::scene {

/// A place on a link. A flexible link takes an interface or a node selection
/// (mesh frame); a rigid link takes a point in its own frame.
struct Place {
  std::string link;
  std::string interface;                         ///< name, or empty
  std::optional<flexbody::NodeSelection> nodes;  ///< of a flexible link
  /// Of a rigid link, or where a coupler's frame is off the middle of the nodes
  /// that it follows; link frame [m].
  std::optional<Vector3> point;
  flexbody::Weighting weighting = flexbody::Weighting::uniform;
};

}  // namespace limber::scene
