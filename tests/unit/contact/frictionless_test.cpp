// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "limber/common/rotation.hpp"
#include "unit/contact/body_on_plane.hpp"

/// Without friction no force acts across the normal: neither spin nor what a
/// body moves along a plane changes.
namespace limber::contact::frictionless_test {
namespace {

using dynamics::IntegratorKind;
using test::BodyOnPlane;
using test::PairScene;

constexpr double kRadius = 0.03;  // [m]
constexpr double kSpeed = 0.5;    // along the plane [m/s]

struct Case {
  IntegratorKind scheme = IntegratorKind::energy_conserving;
  double step = 1e-3;
  double side = 1.0;  // sign of the speed
  bool is_first = false;
  Matrix3 R_WF = Matrix3::Identity();
};

const Case kCases[] = {
    {},
    {.scheme = IntegratorKind::generalized_alpha},
    {.step = 3.7e-4},
    {.side = -1.0},
    {.is_first = true},
    {.R_WF = exp_rotation(Vector3(0.4, -1.1, 0.7))},
};

BodyOnPlane make_body(const Case& of, const ShapeKind& shape) {
  return {.shape = shape,
          .mass = 0.5,
          .moments = Vector3::Constant(1.8e-4),
          .material = {5e9, 0.3},
          .parameters = {.restitution = 1.0},
          .v_F = {of.side * kSpeed, 0.0, 0.0},
          .R_WF = of.R_WF,
          .is_first = of.is_first};
}

// Of the motion along the plane [m/s], and of the spin.
struct Drift {
  double along = 0.0;  // [m/s]
  double spin = 0.0;   // [rad/s]
};

Drift find_drift(const Case& of, PairScene& scene) {
  const Vector3 v_F = of.R_WF.transpose() * scene.body().v_WB_W;
  return {std::hypot(v_F.x() - of.side * kSpeed, v_F.y()),
          scene.body().w_WB_B.norm()};
}

// It was 0.039 rad/s and 4.6e-4 m/s.
TEST(WithoutFriction, ABallThatBouncesFiveTimesGetsNoSpin) {
  for (const Case& of : kCases) {
    BodyOnPlane ball = make_body(of, Sphere{kRadius});
    ball.p_F = {0.0, 0.0, 0.15};
    PairScene scene = ball.make();
    const auto find_energy = [&] {
      return scene.find_energy().total() -
             ball.mass * scene.model.gravity_W.dot(scene.body().p_WB);
    };
    const double before = find_energy();
    scene.go(1.5, of.step, of.scheme);
    EXPECT_EQ(scene.record.contacts.size(), 5U);
    const Drift drift = find_drift(of, scene);
    EXPECT_LT(drift.along, 1e-9);
    EXPECT_LT(drift.spin, 1e-7);
    EXPECT_NEAR(find_energy() / before, 1.0, 1e-11);
  }
}

// It was 4.5e-4 rad/s.
TEST(WithoutFriction, ABoxThatLandsFlatDoesNotTurn) {
  for (const Case& of : kCases) {
    BodyOnPlane box = make_body(of, Box{{0.05, 0.04, 0.03}});
    box.p_F = {0.0, 0.0, 0.04};
    PairScene scene = box.make();
    scene.go(0.1, of.step, of.scheme);
    EXPECT_GE(scene.record.contacts.size(), 1U);
    const Drift drift = find_drift(of, scene);
    EXPECT_LT(drift.along, 1e-9);
    EXPECT_LT(drift.spin, 1e-7);
  }
}

// Only what acts along the normal at a corner turns it; none along the plane.
TEST(WithoutFriction, ABoxThatLandsOnACornerKeepsItsSpeedAlongThePlane) {
  for (const Case& of : kCases) {
    BodyOnPlane box = make_body(of, Box{{0.05, 0.04, 0.03}});
    box.p_F = {0.0, 0.0, 0.1};
    box.R_FB = exp_rotation(Vector3(0.5, 0.3, 0.1));
    PairScene scene = box.make();
    scene.go(0.12, of.step, of.scheme);
    EXPECT_GE(scene.record.contacts.size(), 1U);
    EXPECT_GT(scene.body().w_WB_B.norm(), 1.0);
    EXPECT_LT(find_drift(of, scene).along, 1e-6);
  }
}

}  // namespace
}  // namespace limber::contact::frictionless_test
