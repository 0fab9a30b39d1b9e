// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace limber::reference {

/// Simbody's model of our joints, which are couplers.
enum class JointModel {
  /// Free bodies on force elements with the energy and dissipation of
  /// docs/reference/joints.md, implemented independently in the world frame.
  bushings,
  /// Free bodies on Simbody's own LinearBushing: x-y-z angles in place of the
  /// chordal measure. Equal to first order in the small relative rotation.
  linear_bushings,
  /// Simbody's mobilizers: the limit of infinite stiffness.
  ideal,
};

/// "bushings", "linear-bushings", "ideal".
[[nodiscard]] const std::vector<std::string>& joint_model_names();
/// @throws InputError naming the nearest.
[[nodiscard]] JointModel parse_joint_model(std::string_view name);

}  // namespace limber::reference
