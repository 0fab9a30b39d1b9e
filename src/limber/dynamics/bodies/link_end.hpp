// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/system/system_model.hpp"

namespace limber::dynamics {

/// One end of a coupler or transmission on a body, as Newton's matrix needs it.
struct LinkEnd {
  AttachmentIndex attachment{};
  Eigen::Index row = 0;  ///< the body's first unknown
  /// Relative motion of the link per increment of the body: 6 rows.
  Matrix6X G{};
  Matrix6X Zt{};  ///< (D^-1 G')', D the body's block
  /// Of an unreduced body D^-1 times its frame's motion, in the body frame:
  /// valid for as long as D.
  Matrix6X Zt_B{};
};

}  // namespace limber::dynamics
