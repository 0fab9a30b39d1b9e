// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include "limber/common/rotation.hpp"
#include "limber/contact/potential/pair_potential.hpp"

/// Derivatives of a potential by differences.
namespace limber::contact::test {

inline Patch evaluate(const PairPotential& potential, const Pose& X_WA,
                      const Pose& X_WB) {
  const joints::PairBody A{X_WA.R, X_WA.p};
  const joints::PairBody B{X_WB.R, X_WB.p};
  return potential.evaluate({A, B}, true);
}

/// A pose after a motion of its body about a point.
inline Pose move(const Pose& X, const Vector6& by, const Vector3& about) {
  const Matrix3 R = exp_rotation(by.tail<3>());
  return {R * X.R, about + by.head<3>() + R * (X.p - about)};
}

/// A motion along or about one axis, for differences.
struct SmallMotion {
  explicit SmallMotion(int i) : by(size(i) * Vector6::Unit(i)), h(size(i)) {}
  static double size(int i) { return i < 3 ? 1e-8 : 1e-7; }

  Vector6 by;
  double h;
};

/// Of an energy by motions about `about`. @param energy of Pose
template <typename Energy>
[[nodiscard]] Vector6 find_gradient(const Pose& X, const Vector3& about,
                                    const Energy& energy) {
  Vector6 gradient;
  for (int i = 0; i < 6; ++i) {
    const SmallMotion m(i);
    const double above = energy(move(X, m.by, about));
    const double below = energy(move(X, -m.by, about));
    gradient[i] = (above - below) / (2.0 * m.h);
  }
  return gradient;
}

/// Of a patch's energy, by motions of B about its centre, which stays where it
/// is.
[[nodiscard]] inline Matrix6 find_hessian(const PairPotential& potential,
                                          const Pose& X_WB,
                                          const Vector3& centre_W) {
  const auto gradient = [&](const Vector6& by) -> Vector6 {
    const Patch at = evaluate(potential, {}, move(X_WB, by, centre_W));
    Vector6 g = at.gradient_W;
    g.tail<3>() += (at.centre_W - centre_W).cross(Vector3(g.head<3>()));
    return g;
  };
  Matrix6 hessian;
  for (int i = 0; i < 6; ++i) {
    const SmallMotion m(i);
    hessian.col(i) = (gradient(m.by) - gradient(-m.by)) / (2.0 * m.h);
  }
  return hessian;
}

/// Expects of a pair and of its bodies in the other order one patch.
/// @param place by which the centre may differ [m]
/// @param hessian fraction by which the Hessian may differ
inline void expect_same_patch(const Patch& one, const Patch& other,
                              double place, double hessian) {
  EXPECT_NEAR(other.energy / one.energy, 1.0, 1e-9);
  EXPECT_LT((other.centre_W - one.centre_W).norm(), place);
  EXPECT_LT((other.gradient_W + one.gradient_W).norm(),
            1e-9 * one.gradient_W.norm());
  EXPECT_LT((other.hessian_W - one.hessian_W).norm(),
            hessian * one.hessian_W.norm());
}

}  // namespace limber::contact::test
