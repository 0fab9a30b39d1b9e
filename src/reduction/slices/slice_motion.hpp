// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "limber/reduction/slices/surface_samples.hpp"

/// How a slice of a surface moves as one piece. Part of limber_reduction.
namespace limber::flexbody {

/// The rigid motion (u, theta) about a slice's centre that is nearest to the
/// nodes' displacements, normal to its surface: what a slice has of an end
/// face moves it along, its sides move it across.
///
/// Equation   min sum a ((n . e)^2 + 1e-6 |e|^2), e = u(x) - u - theta x r, r
///            from the centre; so (u, theta) = H^-1 sum_n B_n u_n. Forces f on
///            the slice are loads u' f: B_n' H^-1 (f, 0) on the nodes, whose
///            resultant is f at the centre
/// Limits     what no face presses along, such as the axis of a bar far from
///            its ends, moves with the mean of its surface
class SliceMotion {
 public:
  /// @param samples at least one
  explicit SliceMotion(const std::vector<const SurfaceSample*>& samples);

  /// Of its area, mesh frame [m].
  [[nodiscard]] const Vector3& centre() const { return centre_; }
  /// (u, theta) of each mode, 6 x m. @param Phi 3N x m rows of all nodes
  [[nodiscard]] MatrixX find_motion(const MatrixX& Phi) const;
  /// Loads of unit forces along each axis, 3N x 3. @param nodes N
  [[nodiscard]] MatrixX find_loads(Eigen::Index nodes) const;

 private:
  Vector3 centre_ = Vector3::Zero();
  std::map<int, Eigen::Matrix<double, 6, 3>> nodes_;  // H^-1 B_n
};

}  // namespace limber::flexbody
