// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

namespace limber {

/// Rotation of fixed-axis roll, pitch, yaw (URDF) [rad].
[[nodiscard]] Matrix3 rotation_rpy(const Vector3& rpy);

}  // namespace limber
