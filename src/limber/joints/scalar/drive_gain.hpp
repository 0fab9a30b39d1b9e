// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/joints/scalar/drive.hpp"

namespace limber::joints {

/// Derivatives of a drive's force along its coordinate by its command's value,
/// and by the command's rate.
struct DriveGain {
  double by_value = 0.0;  ///< [N or N m / unit of the command]
  double by_rate = 0.0;   ///< [N s or N m s / unit of the command]
};

/// Both are zero at a limit: of effort, or of a velocity that follows an input.
[[nodiscard]] DriveGain find_gain(const Drive& drive,
                                  const ScalarMotion& motion,
                                  const EvaluationTime& now);

}  // namespace limber::joints
