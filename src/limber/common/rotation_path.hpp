// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

namespace limber {

/// Axes in which an angular velocity is expressed: those of the world or of the
/// rotating body.
enum class RotationAxes { fixed, rotating };

/// Integral of the angular velocity over a step [rad]; NaN where the rotation
/// is not that of the mean angular velocity to 1 rad, so that the number of
/// full turns is unknown.
///
/// Equation   theta + h^2 (w_0 x w_1) / 12, theta = log(R_1 R_0'), in fixed
/// axes,
///            theta - h^2 (w_0 x w_1) / 12, theta = log(R_0' R_1), in rotating
///            ones. Exact about a fixed axis, else with an error of h^5.
/// Source     w = theta' +- theta x theta' / 2 + ... ([@sola2018], the left and
///            the right Jacobian), with w linear in time in the second term
/// @param R R_1 R_0' or R_0' R_1, of the axes [-]
/// @param w_0, w_1 at both ends [rad/s]
/// @param h length of the step [s]
[[nodiscard]] Vector3 integrate_rotation(const Matrix3& R, const Vector3& w_0,
                                         const Vector3& w_1, double h,
                                         RotationAxes axes);

}  // namespace limber
