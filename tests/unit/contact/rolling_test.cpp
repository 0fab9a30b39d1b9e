// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "limber/common/rotation.hpp"
#include "limber/contact/make_contact.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "unit/contact/pair_scene.hpp"

/// Balls and cylinders that roll against rolling friction, by closed forms.
namespace limber::contact::rolling_test {
namespace {

using Scene = test::PairScene;

constexpr double kRadius = 0.05;   // [m]
constexpr double kMass = 1.0;      // [kg]
constexpr double kGravity = 9.81;  // [m/s^2]
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr SurfaceMaterial kRubber{1e8, 0.4};

// A body that rolls along x, of the inertia ratio mass R^2.
struct Wheel {
  ShapeKind shape = Sphere{kRadius};
  double ratio = 0.4;
  Matrix3 R_WB = Matrix3::Identity();
  bool is_first = false;  // whether it is A

  [[nodiscard]] double depth_at_rest(double modulus) const {
    const double k = 4.0 / 3.0 * modulus * std::sqrt(kRadius);
    return std::holds_alternative<Sphere>(shape)
               ? std::pow(kMass * kGravity / k, 2.0 / 3.0)
               : 0.0;
  }
};

const Wheel kBall{};
const Wheel kRoller{Cylinder{kRadius, 0.1}, 0.5,
                    exp_rotation(Vector3(std::numbers::pi / 2, 0, 0))};

Scene make_scene(const Wheel& wheel, const ContactParameters& parameters,
                 double slope, double speed = 0.0) {
  dynamics::SystemBuilder builder;
  const Matrix3 inertia =
      wheel.ratio * kMass * kRadius * kRadius * Matrix3::Identity();
  const auto body = builder.add_rigid_body("wheel", {kMass, inertia});
  const ContactSide side{Shape{wheel.shape, {}}, kRubber, kMass, inertia};
  const ContactSide floor{Shape{HalfSpace{}, {}}, {}, kInfinity};
  if (wheel.is_first) {
    builder.add_pair("p", body, dynamics::kWorld,
                     make_contact(side, floor, parameters));
  } else {
    builder.add_pair("p", dynamics::kWorld, body,
                     make_contact(floor, side, parameters));
  }
  Scene scene{builder.build(), {}};
  scene.model.gravity_W =
      kGravity * Vector3(std::sin(slope), 0.0, -std::cos(slope));
  scene.state = make_state(scene.model);
  dynamics::BodyState& at = scene.state.bodies[0];
  at.quat_WB = Quaternion(wheel.R_WB);
  const double modulus = kRubber.youngs_modulus / (1.0 - 0.16);
  at.p_WB = {0.0, 0.0, kRadius - wheel.depth_at_rest(modulus)};
  at.v_WB_W = {speed, 0.0, 0.0};
  at.w_WB_B = wheel.R_WB.transpose() * Vector3(0.0, speed / kRadius, 0.0);
  return scene;
}

ContactParameters with_arm(double arm) {
  return {.friction = {.sliding = 0.5},
          .rolling_friction = arm,
          .restitution = 0.5};
}

// (1 + ratio) m a = -b N / R.
TEST(RollingFriction, SlowsARollingBodyDownByItsArmOverTheRadius) {
  const double arm = 1e-3;
  for (const Wheel& wheel : {kBall, kRoller}) {
    Scene scene = make_scene(wheel, with_arm(arm), 0.0, 1.0);
    scene.go(0.2, 1e-3);
    const double early = scene.body().v_WB_W.x();
    scene.go(1.2, 1e-3);
    const double slowed = early - scene.body().v_WB_W.x();
    const double expected = kGravity * arm / kRadius / (1.0 + wheel.ratio);
    EXPECT_NEAR(slowed / expected, 1.0, 2e-3);
  }
}

// (1/2) (1 + ratio) m v^2 = b N x / R.
TEST(RollingFriction, BringsARollingBodyToRest) {
  const double arm = 2e-3;
  for (Wheel wheel : {kBall, kRoller}) {
    for (const bool is_first : {false, true}) {
      wheel.is_first = is_first;
      Scene scene = make_scene(wheel, with_arm(arm), 0.0, 0.3);
      scene.go(4.0, 1e-3);
      const double x = scene.body().p_WB.x();
      const double expected =
          0.5 * (1.0 + wheel.ratio) * 0.09 * kRadius / (arm * kGravity);
      EXPECT_NEAR(x / expected, 1.0, 5e-3);
      scene.go(8.0, 1e-3);
      EXPECT_LT(std::abs(scene.body().p_WB.x() - x), 1e-7);
      EXPECT_LT(scene.body().v_WB_W.norm(), 1e-9);
      EXPECT_LT(scene.body().w_WB_B.norm(), 1e-8);
    }
  }
}

TEST(RollingFriction, HoldsABodyOnASlopeBelowItsArmOverTheRadius) {
  const double arm = 2e-3;
  for (const Wheel& wheel : {kBall, kRoller}) {
    Scene held =
        make_scene(wheel, with_arm(arm), std::atan(0.9 * arm / kRadius));
    held.go(3.0, 1e-3);
    const double x = held.body().p_WB.x();
    EXPECT_LT(std::abs(x), 0.05 * kRadius);
    held.go(6.0, 1e-3);
    EXPECT_LT(std::abs(held.body().p_WB.x() - x), 1e-9);
  }
}

TEST(RollingFriction, LetsABodyRollOnASteeperSlope) {
  const double arm = 2e-3;
  const double slope = 0.1;
  for (const Wheel& wheel : {kBall, kRoller}) {
    Scene scene = make_scene(wheel, with_arm(arm), slope);
    scene.go(0.3, 1e-3);
    const double early = scene.body().v_WB_W.x();
    scene.go(0.8, 1e-3);
    const double a = (scene.body().v_WB_W.x() - early) / 0.5;
    const double expected =
        kGravity * (std::sin(slope) - arm / kRadius * std::cos(slope)) /
        (1.0 + wheel.ratio);
    EXPECT_NEAR(a / expected, 1.0, 2e-3);
  }
}

TEST(RollingFriction, IsAskedForAndNeverActsElse) {
  for (const Wheel& wheel : {kBall, kRoller}) {
    Scene scene = make_scene(wheel, with_arm(0.0), 0.0, 1.0);
    scene.go(0.5, 1e-3);  // it settles
    const double early = scene.body().v_WB_W.x();
    scene.go(2.0, 1e-3);
    EXPECT_NEAR(scene.body().v_WB_W.x(), early, 1e-6);
  }
}

TEST(RollingFriction, BalancesItsLosses) {
  for (const Wheel& wheel : {kBall, kRoller}) {
    Scene scene = make_scene(wheel, with_arm(2e-3), 0.02, 0.4);
    scene.go(2.0, 1e-3);
    EXPECT_LT(std::abs(scene.record.energy.drift.value),
              1e-3 * scene.record.energy.throughput);
  }
}

}  // namespace
}  // namespace limber::contact::rolling_test
