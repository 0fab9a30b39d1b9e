// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

namespace limber::contact {

/// A factor of W, and its derivatives by a motion over its value.
struct Factor {
  double value = 1.0;                ///< [-]
  Vector6 rate = Vector6::Zero();    ///< first [1/m, 1/rad]
  Matrix6 second = Matrix6::Zero();  ///< second, about [1/m^2, ...]

  [[nodiscard]] Factor operator*(const Factor& other) const;
  /// Of motions in other axes or about another point: theirs are T times those.
  [[nodiscard]] Factor transform(const Matrix6& T) const;
};

/// How much stiffer an elongated contact area is than a round one of the same
/// M: as an elliptical flat punch than a round one of its area.
///
/// Equation   phi = pi sqrt(s) / (2 K(m)), m = 1 - 1/s^2, s^2 + 1/s^2 + 2 = 4
/// u,
///            u = tr^2 / (4 det) of the second moments in the plane, s the
///            ratio of their roots
/// Source     [@johnson1985, sec. 3.5]; K and E by arithmetic-geometric means
struct ShapeFactor {
  double phi = 1.0;
  double slope = 0.0;  ///< d ln phi / d ln u
};

/// @param u >= 1 [-]
[[nodiscard]] ShapeFactor find_shape_factor(double u);

/// u of second moments, seen along n, and its derivative.
struct Elongation {
  double u = 1.0;
  Matrix3 by_moments = Matrix3::Zero();  ///< d ln u / d S, symmetric [1/m^2]
};

/// @param S positive semidefinite [m^2]
/// @param n unit
[[nodiscard]] Elongation find_elongation(const Matrix3& S, const Vector3& n);

}  // namespace limber::contact
