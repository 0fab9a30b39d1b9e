// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"
#include "limber/contact/potential/convex_solid.hpp"
#include "limber/contact/potential/polytope.hpp"
#include "limber/contact/potential/shape_factor.hpp"

namespace limber::contact {

/// Integrals over the overlap of two bodies, of the depth t below the surface
/// of one of them, about a point o, in one set of axes. g is the derivative of
/// t by a motion (u, theta) of B against A.
///
/// Equation   M = int 4 t^3 dV, m1 = dM = int 12 t^2 g dV - int 4 t^3 (n, r x
///            n) dS over the faces of `soft` that do not press; m2 its
///            derivative, without that of these faces,
///            along the motion exp(u, theta) except for terms of theta x u:
///            int 24 t g g' dV - sum over interfaces of faces i, j
///            int 12 t^2 dg dg' / |n_i - n_j| dS - sum_i rotation of the normal
struct DepthMoments {
  double M = 0.0;                ///< [m^6]
  Vector6 m1 = Vector6::Zero();  ///< [m^5, m^6]
  Matrix6 m2 = Matrix6::Zero();  ///< [m^4, m^5; m^5, m^6]
  /// int 12 t^2 dV of each face's fraction along the resultant, n . m1 / |m1|
  /// >= 0, here and below [m^5].
  double pressure = 0.0;
  Vector3 first = Vector3::Zero();   ///< int 12 t^2 r dV [m^6]
  Matrix3 second = Matrix3::Zero();  ///< int 12 t^2 r r' dV [m^7]
  double depth = 0.0;                ///< largest [m]
  Factor factor;                     ///< of W, 1 of polyhedra
};

/// @param soft whose depth counts, placed by X
/// @param overlap of both, relative to o in the axes of X
/// @param X the pose of `soft` in these axes, o its origin
/// @param side 0 if `soft` is A, against which B moves, 1 if it is B
/// @param has_derivatives whether m2 is filled
[[nodiscard]] DepthMoments find_depth_moments(const ConvexSolid& soft,
                                              const Pose& X,
                                              const Polytope& overlap, int side,
                                              bool has_derivatives);

}  // namespace limber::contact
