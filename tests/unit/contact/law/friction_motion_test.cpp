// SPDX-License-Identifier: BSD-3-Clause
// Blocks and spheres that shells hold or slow down, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limber/contact/law/load_shells.hpp"

namespace limber::contact::friction_motion_test {
namespace {

// One shell of a flat.
struct Shells {
  LoadShells law;
  double stiffness;  // [N/m]
  double damping;    // [N s/m]
};

Shells make_friction(double mu, double stiffness, double damping) {
  return {LoadShells({.limit = {.sliding = mu}}), stiffness, damping};
}

// A point mass in a plane, by the trapezoidal rule and Newton's method with
// the law's derivatives.
class Slider {
 public:
  Slider(const Shells& friction, double mass, double speed)
      : friction_(friction), mass_(mass), v_(speed, 0.0, 0.0) {}

  // Under a tangential force and a pressing one at the step's end [N].
  void step(double h, double pull, double press) {
    const Vector3 load(pull, 0.0, 0.0);
    const Vector3 sum0 = load_ + force_;
    Vector3 v1 = v_;
    for (int i = 0; i < 50; ++i) {
      const Vector3 increment = 0.5 * h * (v_ + v1);
      response_ = friction_.law.evaluate(
          memory_, {.force = press, .stiffness = friction_.stiffness},
          {increment, v1}, friction_.damping);
      const Vector3 residual =
          mass_ / h * (v1 - v_) - 0.5 * (sum0 + load + response_.force);
      const Matrix3 tangent =
          mass_ / h * Matrix3::Identity() -
          0.5 * (0.5 * h * response_.by_increment + response_.by_velocity);
      const Vector3 change = tangent.partialPivLu().solve(residual);
      v1 -= change;
      most_iterations = std::max(most_iterations, i + 1);
      if (change.norm() < 1e-14 + 1e-13 * v1.norm()) break;
    }
    impulse += 0.5 * h * (force_ + response_.force).x();
    x_ += 0.5 * h * (v_ + v1);
    v_ = v1;
    load_ = load;
    force_ = response_.force;
    memory_ = response_.next;
    slip_work += response_.slip_work;
    damper_work += h * response_.damper_power;
  }

  [[nodiscard]] double x() const { return x_.x(); }
  [[nodiscard]] double v() const { return v_.x(); }
  [[nodiscard]] const ShellResponse& response() const { return response_; }

  double slip_work = 0.0;
  double damper_work = 0.0;
  double impulse = 0.0;
  int most_iterations = 0;

 private:
  Shells friction_;
  double mass_;
  Vector3 x_ = Vector3::Zero();
  Vector3 v_;
  Vector3 load_ = Vector3::Zero();
  Vector3 force_ = Vector3::Zero();
  ShellMemory memory_;
  ShellResponse response_;
};

constexpr double kGravity = 9.81;
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kStiffness = 8.2e5;

enum class Shake { none, tangential, normal };

// 10 s on the slope, which is tilted within 0.2 s; mass 1 kg.
Slider hold(const Shells& friction, double angle, Shake shake) {
  const double h = 1e-4;
  const double press = kGravity * std::cos(angle);
  Slider block(friction, 1.0, 0.0);
  for (int i = 1; i <= 100000; ++i) {
    const double t = h * i;
    const double wave = 0.3 * std::sin(2.0 * std::numbers::pi * 20.0 * t);
    double pull = kGravity * std::sin(angle) * std::min(1.0, t / 0.2);
    if (shake == Shake::tangential) pull += 0.3 * press * wave;
    block.step(h, pull, shake == Shake::normal ? press * (1.0 + wave) : press);
  }
  return block;
}

TEST(LoadShellMotion, ABlockOnASlopeHoldsWithItsElasticDisplacementOnly) {
  const Shells friction =
      make_friction(0.3, kStiffness, find_spring_damping(kStiffness, 1.0));
  const double elastic = kGravity * std::sin(10.0 * kDegree) / kStiffness;
  EXPECT_LT(elastic, 3e-6);
  for (const Shake shake : {Shake::none, Shake::tangential, Shake::normal}) {
    const Slider block = hold(friction, 10.0 * kDegree, shake);
    EXPECT_EQ(block.slip_work, 0.0);
    // At t = 10 s the shake passes zero; its velocity lags by the damper.
    EXPECT_NEAR(block.x() / elastic, 1.0,
                shake == Shake::tangential ? 0.02 : 1e-9);
    EXPECT_LE(block.most_iterations, 3);
  }
}

TEST(LoadShellMotion, ABlockOnASteepSlopeSlidesAsCoulombSays) {
  const Shells friction =
      make_friction(0.3, kStiffness, find_spring_damping(kStiffness, 1.0));
  const double angle = 20.0 * kDegree;
  const double h = 1e-4;
  Slider block(friction, 1.0, 0.0);
  double v = 0.0;
  for (int i = 1; i <= 10000; ++i) {
    block.step(h, kGravity * std::sin(angle), kGravity * std::cos(angle));
    if (i == 5000) v = block.v();
  }
  const double expected = kGravity * (std::sin(angle) - 0.3 * std::cos(angle));
  EXPECT_NEAR((block.v() - v) / 0.5, expected, 1e-10);
  EXPECT_TRUE(block.response().slips);
  EXPECT_LE(block.most_iterations, 5);
}

TEST(LoadShellMotion, StaticFrictionHoldsWhatItDoesNotStop) {
  const Shells friction(
      {.law = LoadShells(
           {.limit = {.sliding = 0.3, .excess = 0.2, .speed = 0.01}}),
       .stiffness = kStiffness,
       .damping = find_spring_damping(kStiffness, 1.0)});
  const double angle = 20.0 * kDegree;  // tan = 0.364
  const double h = 1e-4;
  EXPECT_EQ(hold(friction, angle, Shake::none).slip_work, 0.0);
  Slider pushed(friction, 1.0, 0.2);
  double v = 0.0;
  for (int i = 1; i <= 10000; ++i) {
    pushed.step(h, kGravity * std::sin(angle), kGravity * std::cos(angle));
    if (i == 5000) v = pushed.v();
  }
  EXPECT_NEAR((pushed.v() - v) / 0.5,
              kGravity * (std::sin(angle) - 0.3 * std::cos(angle)), 1e-8);
}

// A solid sphere of speed v0 without spin: the point of contact has the mass
// 1 / (1/m + R^2/J) = 2 m / 7. It rolls from t = 2 v0 / (7 mu g) on with
// 5 v0 / 7, whatever mu.
TEST(LoadShellMotion, ASphereThatSlidesEndsRolling) {
  const double m = 0.033;
  const double h = 1e-5;
  for (const double mu : {0.1, 0.3}) {
    const double c = find_spring_damping(1e4, m);
    Slider slip(make_friction(mu, 1e4, c), 2.0 * m / 7.0, 1.0);
    double last_slip = 0.0;
    for (int i = 1; i <= 60000; ++i) {
      slip.step(h, 0.0, m * kGravity);
      if (slip.response().slips) last_slip = h * i;
    }
    const double v = 1.0 + slip.impulse / m;
    const double rim = -slip.impulse / (0.4 * m);  // R w
    EXPECT_NEAR(v, 5.0 / 7.0, 1e-6);
    EXPECT_NEAR(rim, v, 1e-6);
    EXPECT_NEAR(last_slip, 2.0 / (7.0 * mu * kGravity), 1e-3);
    const double before = 0.5 * m;
    const double after = 0.5 * m * v * v + 0.5 * 0.4 * m * rim * rim;
    EXPECT_NEAR((slip.slip_work + slip.damper_work) / (before - after), 1.0,
                1e-3);
  }
}

}  // namespace
}  // namespace limber::contact::friction_motion_test
