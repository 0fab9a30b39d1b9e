// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/rotation.hpp"

namespace limber::dynamics {

/// Change of c per small rotation x, where R cay(c) becomes R cay(c) exp(x).
///
/// Equation   dc = (I + skew(c) / 2 + c c' / 4) x
/// Source     the inverse of the right-trivialised derivative of Cayley's
///            transform cay(c) = (I - skew(c) / 2)^-1 (I + skew(c) / 2)
/// Limits     none: |c| = 2 tan(angle / 2), so that at large angles a small
///            x changes it much.
[[nodiscard]] inline Matrix3 cayley_jacobian_inverse(const Vector3& c) {
  return Matrix3::Identity() + skew(0.5 * c) + 0.25 * c * c.transpose();
}

}  // namespace limber::dynamics
