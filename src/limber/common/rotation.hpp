// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

/// Rotations on the group SO(3). Angles in radians.
///
/// Source     Sola, Deray, Atchuthan, "A micro Lie theory for state
///            estimation in robotics", 2018, eqs. 132-146.
namespace limber {

/// Cross-product matrix: skew(a) b = a x b.
[[nodiscard]] Matrix3 skew(const Vector3& a);

/// Unit quaternion of the rotation vector `theta` [rad].
[[nodiscard]] Quaternion exp_quaternion(const Vector3& theta);

/// Rotation matrix of the rotation vector `theta` [rad].
[[nodiscard]] Matrix3 exp_rotation(const Vector3& theta);

/// Rotation vector [rad], |theta| <= pi, of a rotation; accurate at 0 and pi.
[[nodiscard]] Vector3 log_rotation(const Quaternion& rotation);
[[nodiscard]] Vector3 log_rotation(const Matrix3& rotation);

/// Left Jacobian J_l: exp(theta(t)) has the angular velocity J_l(theta)
/// thetadot, expressed in the outer frame.
[[nodiscard]] Matrix3 left_jacobian(const Vector3& theta);

/// Derivative of left_jacobian at `theta` along `direction`.
[[nodiscard]] Matrix3 left_jacobian_derivative(const Vector3& theta,
                                               const Vector3& direction);

/// Right Jacobian J_r(theta) = J_l(-theta): the same expressed in the inner
/// (rotated) frame.
[[nodiscard]] Matrix3 right_jacobian(const Vector3& theta);

/// Inverse of the right Jacobian; |theta| < 2 pi.
[[nodiscard]] Matrix3 right_jacobian_inverse(const Vector3& theta);

}  // namespace limber
