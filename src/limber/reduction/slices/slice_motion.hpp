// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "limber/reduction/slices/surface_samples.hpp"

/// How a slice of a surface moves as one piece. Part of limber_reduction.
namespace limber::flexbody {

/// The rigid motion (u, theta) about a slice's centre that is nearest to the
/// nodes' displacements, normal to its surface: what a slice has of an end
/// face moves it along, its sides move it across. In motions along which no
/// face is pressed, such as along and about the axis of a round rod far from
/// its ends, all of the surface moves it, and friction is spread over it.
///
/// Equation   G B u + P W^-1 C u: H = sum a J n n' J', B u = sum a J n n' u(x),
///            J = (1; r x); W and C the same with 1 for n n'; G the inverse of
///            H among its eigenvectors, theta in units of 1 / sqrt(<r^2>),
///            whose value is above 2e-3 of the largest, P onto the others. It
///            is (u, theta) of every rigid motion, so forces f are loads whose
///            resultant is f at the centre
class SliceMotion {
 public:
  /// (u, theta) by a node's displacement.
  using Contribution = Eigen::Matrix<double, 6, 3>;

  /// @param samples at least one
  explicit SliceMotion(const std::vector<const SurfaceSample*>& samples);

  /// Of its area, mesh frame [m].
  [[nodiscard]] const Vector3& centre() const { return centre_; }
  /// Of each node of the mesh that it has.
  [[nodiscard]] const std::map<int, Contribution>& nodes() const {
    return nodes_;
  }
  /// (u, theta) of each mode, 6 x m. @param Phi 3N x m rows of all nodes
  [[nodiscard]] MatrixX find_motion(const MatrixX& Phi) const;
  /// Loads of unit forces along each axis, 3N x 3. @param nodes N
  [[nodiscard]] MatrixX find_loads(Eigen::Index nodes) const;

 private:
  Vector3 centre_ = Vector3::Zero();
  std::map<int, Contribution> nodes_;
};

}  // namespace limber::flexbody
