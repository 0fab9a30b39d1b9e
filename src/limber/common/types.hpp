// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <limits>

/// Short names for the Eigen types that every layer uses.
namespace limber {

using Vector3 = Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix3 = Eigen::Matrix3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix3X = Eigen::Matrix3Xd;
using Matrix6X = Eigen::Matrix<double, 6, Eigen::Dynamic>;
using VectorX = Eigen::VectorXd;
using MatrixX = Eigen::MatrixXd;
using Quaternion = Eigen::Quaterniond;

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace limber
