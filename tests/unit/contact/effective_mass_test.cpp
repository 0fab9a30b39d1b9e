// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/effective_mass.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "unit/contact/draw.hpp"

/// Against the change of the normal speed by an impulse on rigid bodies.
namespace limber::contact::effective_mass_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Body {
  double mass;
  Matrix3 inertia_B;
  joints::PairBody pose;
};

Body draw_body(test::Draw& draw) {
  Body body{draw.log_between(0.1, 10.0), {}, {}};
  const Vector3 squares =
      Vector3::Constant(1.2) + 0.4 * draw.vector();  // a triangle's sides
  const Matrix3 R = exp_rotation(draw.vector());
  body.inertia_B = body.mass * (R * squares.asDiagonal() * R.transpose());
  body.pose.R_WB = exp_rotation(2.0 * draw.vector());
  body.pose.p_WB = draw.vector();
  return body;
}

// Velocity of the point at p_W after an impulse there, from rest.
Vector3 strike(const Body& body, const Vector3& p_W, const Vector3& impulse_W) {
  const Matrix3 J_W =
      body.pose.R_WB * body.inertia_B * body.pose.R_WB.transpose();
  const Vector3 r = p_W - body.pose.p_WB;
  const Vector3 w = J_W.ldlt().solve(r.cross(impulse_W));
  return impulse_W / body.mass + w.cross(r);
}

TEST(InverseMass, OfOnePointIsTheSpeedByAUnitImpulse) {
  test::Draw draw(7);
  for (int i = 0; i < 20; ++i) {
    const Body A = draw_body(draw);
    const Body B = draw_body(draw);
    const joints::PairBodies bodies{A.pose, B.pose};
    const Vector3 p_W = draw.vector();
    const Vector3 n_W = draw.vector().normalized();
    NormalLoad load;
    const double F = draw.log_between(1e-3, 1e3);
    load.add(bodies, p_W, F * n_W);
    const double found =
        find_inverse_mass(FreeBody(A.mass, A.inertia_B),
                          FreeBody(B.mass, B.inertia_B), bodies, load, F);
    const Vector3 parting = strike(B, p_W, n_W) + strike(A, p_W, n_W);
    EXPECT_NEAR(found / n_W.dot(parting), 1.0, 1e-12);
  }
}

TEST(InverseMass, OfParallelForcesIsThatAtTheirCentre) {
  test::Draw draw(3);
  const Body A = draw_body(draw);
  const Body B = draw_body(draw);
  const joints::PairBodies bodies{A.pose, B.pose};
  const FreeBody free_A(A.mass, A.inertia_B);
  const FreeBody free_B(B.mass, B.inertia_B);
  const Vector3 n_W = draw.vector().normalized();
  const Vector3 p = draw.vector();
  const Vector3 q = draw.vector();
  NormalLoad both;
  both.add(bodies, p, 2.0 * n_W);
  both.add(bodies, q, 3.0 * n_W);
  NormalLoad centre;
  centre.add(bodies, (2.0 * p + 3.0 * q) / 5.0, n_W);
  EXPECT_NEAR(find_inverse_mass(free_A, free_B, bodies, both, 5.0) /
                  find_inverse_mass(free_A, free_B, bodies, centre, 1.0),
              1.0, 1e-12);
}

// Two walls at an angle a to the motion: each sees v cos a, and W is shared, so
// that 2 W cos^2 a / m is the square that a speed along the normals gains.
TEST(InverseMass, OfAGrooveIsThatAlongItsMiddle) {
  const Body world{kInfinity, Matrix3::Zero(), {}};
  const joints::PairBodies bodies{world.pose, world.pose};
  const FreeBody fixed(kInfinity, Matrix3::Zero());
  const FreeBody body(2.0, Matrix3::Identity());
  const double a = 0.7;
  NormalLoad load;
  for (const double side : {1.0, -1.0}) {
    load.add(bodies, {-side * 0.1, 0.0, 0.0},
             4.0 * Vector3(side * std::sin(a), 0.0, std::cos(a)));
  }
  EXPECT_NEAR(find_inverse_mass(fixed, body, bodies, load, 8.0),
              std::cos(a) * std::cos(a) / 2.0, 1e-15);
}

TEST(InverseMass, OfTheWorldIsNone) {
  joints::PairBody pose;
  pose.p_WB = {1.0, 2.0, 3.0};
  const joints::PairBodies bodies{pose, pose};
  const FreeBody fixed(kInfinity, Matrix3::Zero());
  NormalLoad load;
  load.add(bodies, Vector3::UnitX(), Vector3::UnitY());
  EXPECT_EQ(find_inverse_mass(fixed, fixed, bodies, load, 1.0), 0.0);
}

TEST(InverseMass, IsOfBodiesThatHaveOne) {
  EXPECT_THROW(FreeBody(0.0, Matrix3::Zero()), ContractError);
  EXPECT_THROW(FreeBody(1.0, -Matrix3::Identity()), ContractError);
}

}  // namespace
}  // namespace limber::contact::effective_mass_test
