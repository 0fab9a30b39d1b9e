// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>

#include "limber/common/types.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"

namespace limber::contact {

/// A wrench on B and the opposite one on A about a point c of the world, and
/// their derivatives by the motion of B relative to A about c.
///
/// Equation   d wrench = -stiffness d motion - damping d twist
struct PatchWrench {
  Vector6 wrench_W = Vector6::Zero();     ///< force, moment [N, N m]
  Matrix6 stiffness_W = Matrix6::Zero();  ///< [N/m, N; N, N m]
  Matrix6 damping_W = Matrix6::Zero();    ///< [N s/m, N s; N s, N m s]
};

/// A wrench as forces at three points about c, which carry it and its tangents
/// exactly.
///
/// Equation   points r_i of an equilateral triangle; a motion of all of them by
///            d_i is u = sum d_i / 3, theta = J^-1 sum r_i x d_i, J = sum |r|^2
///            1
///            - r r'; so the forces are f / 3 + (J^-1 m) x r_i
class PatchPoints {
 public:
  static constexpr std::size_t kCount = 3;

  /// @param normal_W of the triangle's plane, unit [-]
  /// @param radius of its corners from c > 0 [m]
  PatchPoints(const Vector3& centre_W, const Vector3& normal_W, double radius);

  /// Of the points.
  [[nodiscard]] std::array<Vector3, kCount> places_W() const;
  /// Sets forces and tangents of kCount points of a response, from `first` on.
  void set(const PatchWrench& patch, std::size_t first,
           joints::PairResponse& out) const;
  /// The motion about c of displacements of the points of B against A.
  [[nodiscard]] Vector6 find_motion(
      const std::array<Vector3, kCount>& displacements) const;

 private:
  using Matrix63 = Eigen::Matrix<double, 6, 3>;

  Vector3 centre_W_;
  std::array<Vector3, kCount> arms_W_;
  std::array<Matrix63, kCount> motions_;  // of c by each point's
};

}  // namespace limber::contact
