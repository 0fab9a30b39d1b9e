// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>

namespace SimTK {

/// Simbody 3.7 is C++17: in C++20, which also considers reversed comparisons,
/// `==` between two of its index types is ambiguous. It compares both as int;
/// being an exact match, this overload is preferred.
template <typename Index>
requires requires(const Index& i) {
  { i.isValidExtended() } -> std::same_as<bool>;
  { i.operator int() } -> std::same_as<int>;
}
[[nodiscard]] bool operator==(const Index& a, const Index& b) {
  return static_cast<int>(a) == static_cast<int>(b);
}

}  // namespace SimTK

// Excludes an unused helper, whose vectors of incomplete types are not C++20.
#define SimTK_SIMMATH_MULTIBODY_GRAPH_MAKER_H_
#include <Simbody.h>

#include "limber/common/pose.hpp"

/// Our small types to Simbody's and back. Not installed.
namespace limber::reference {

[[nodiscard]] inline SimTK::Vec3 to_simtk(const Vector3& v) {
  return {v.x(), v.y(), v.z()};
}
[[nodiscard]] inline SimTK::Mat33 to_simtk(const Matrix3& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1),
          m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}
[[nodiscard]] inline SimTK::Transform to_simtk(const Pose& X) {
  SimTK::Rotation R;
  R.setRotationFromMat33TrustMe(to_simtk(X.R));
  return {R, to_simtk(X.p)};
}
[[nodiscard]] inline Vector3 from_simtk(const SimTK::Vec3& v) {
  return {v[0], v[1], v[2]};
}
[[nodiscard]] inline Matrix3 from_simtk(const SimTK::Mat33& m) {
  Matrix3 out;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) out(i, j) = m(i, j);
  }
  return out;
}

}  // namespace limber::reference
