// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/shape_factor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace limber::contact::shape_factor_test {
namespace {

double find_u(double s) { return 0.25 * (s + 1.0 / s) * (s + 1.0 / s); }

TEST(ShapeFactor, IsThatOfAnEllipticalPunch) {
  for (const double s : {1.0, 1.001, 2.0, 10.0, 1e3}) {
    const double K = std::comp_ellint_1(std::sqrt(1.0 - 1.0 / (s * s)));
    EXPECT_NEAR(find_shape_factor(find_u(s)).phi,
                std::numbers::pi * std::sqrt(s) / (2.0 * K), 1e-6);
  }
}

TEST(ShapeFactor, HasTheSlopeOfItsLogarithm) {
  for (const double s : {1.02, 1.5, 10.0, 1e3}) {
    const double u = find_u(s);
    const double h = 1e-5;
    const double slope = (std::log(find_shape_factor(u * (1.0 + h)).phi) -
                          std::log(find_shape_factor(u * (1.0 - h)).phi)) /
                         (2.0 * h);
    EXPECT_NEAR(find_shape_factor(u).slope, slope, 1e-5);
  }
}

TEST(ShapeFactor, FollowsTheMomentsSeenAlongTheNormal) {
  const Vector3 n = Vector3(0.3, 0.2, 0.9).normalized();
  Matrix3 S;
  S << 3.0, 0.2, 0.1, 0.2, 1.0, 0.3, 0.1, 0.3, 0.5;
  Matrix3 change;
  change << 0.3, 0.1, -0.2, 0.1, 0.5, 0.7, -0.2, 0.7, 0.1;
  const double h = 1e-6;
  const double slope = (std::log(find_elongation(S + h * change, n).u) -
                        std::log(find_elongation(S - h * change, n).u)) /
                       (2.0 * h);
  const Elongation form = find_elongation(S, n);
  EXPECT_NEAR(form.by_moments.cwiseProduct(change).sum(), slope, 1e-8);
  const Vector3 flat(4.0, 1.0, 7.0);
  EXPECT_NEAR(find_elongation(flat.asDiagonal(), Vector3::UnitZ()).u,
              find_u(2.0), 1e-12);
}

}  // namespace
}  // namespace limber::contact::shape_factor_test
