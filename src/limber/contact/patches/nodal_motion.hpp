// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/pose.hpp"
#include "limber/flexbody/model/full_contact_surface.hpp"

namespace limber::contact {

/// How a piece of the surface of a body at level `full` moves as one: with the
/// pose in which the fit to the displacements of its nodes is zero, for
/// rotations of any size.
///
/// Equation   M e = 0, e_n = Q' (x_n - p) - X_n with the pose (p, Q) of the
///            piece's centre against the undeformed one, X_n the node from
///            there; so its rate is (1 + N)^-1 M Q' x', N = M (0, -[e_n])
/// Source     corotational: [@felippa2005]; begun from the rotation of
/// [@horn1987]
class NodalMotion {
 public:
  explicit NodalMotion(flexbody::NodalPiece piece);

  /// Least number of coordinates of a body that has its nodes.
  [[nodiscard]] Eigen::Index least_coordinates() const;

  struct State {
    Pose X;  ///< p from the undeformed centre, Q; body's axes
    Matrix6 by_fit = Matrix6::Identity();  ///< (1 + N)^-1
  };
  /// @param u displacements of all nodes of the body [m]
  /// @throws NumericalError if there is no such pose.
  [[nodiscard]] State find_state(const double* u) const;
  /// (v, w) of the centre, its own axes. @param udot of all nodes [m/s]
  [[nodiscard]] Vector6 find_rate(const State& state, const double* udot) const;
  /// The displacement of a point of the piece by those of all nodes.
  /// @param x_P from the centre @param out 3 x the body's coordinates
  void set_rows(const State& state, const Vector3& x_P, Matrix3X& out) const;

 private:
  struct Fit;
  [[nodiscard]] Pose begin(const double* u) const;
  [[nodiscard]] Fit fit(const Pose& X, const double* u) const;

  flexbody::NodalPiece piece_;
  double size_;  // largest distance of a node from the centre [m]
};

}  // namespace limber::contact
