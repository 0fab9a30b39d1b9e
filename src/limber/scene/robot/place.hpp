// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "limber/common/types.hpp"
#include "limber/flexbody/model/recipe.hpp"

namespace limber::scene {

/// A place on a link. A flexible link takes an interface or a node selection
/// (mesh frame); a rigid link takes a point in its own frame.
struct Place {
  std::string link;
  std::string interface;                         ///< name, or empty
  std::optional<flexbody::NodeSelection> nodes;  ///< of a flexible link
  /// On a rigid link, or a coupler frame's origin away from the mean point of
  /// its nodes; link frame [m].
  std::optional<Vector3> point;
  flexbody::Weighting weighting = flexbody::Weighting::uniform;
};

}  // namespace limber::scene
