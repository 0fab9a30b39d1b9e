// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/scalar/end_stop.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/differences.hpp"

namespace limber::joints::end_stop_test {
namespace {

// A free mass against a stop, from z = upper with `speed`.
class Bounce {
 public:
  Bounce(const EndStop& stop, double mass) : stop_(stop), mass_(mass) {}

  // One step of fourth-order Runge-Kutta.
  [[nodiscard]] ScalarMotion step(const ScalarMotion& m, double h) const {
    const ScalarMotion a = rate(m);
    const ScalarMotion b = rate(add(m, 0.5 * h, a));
    const ScalarMotion c = rate(add(m, 0.5 * h, b));
    const ScalarMotion d = rate(add(m, h, c));
    return {m.z + h / 6.0 * (a.z + 2.0 * b.z + 2.0 * c.z + d.z),
            m.rate + h / 6.0 * (a.rate + 2.0 * b.rate + 2.0 * c.rate + d.rate)};
  }

  // The motion when it leaves, and the time until then [s].
  ScalarMotion run(double speed, double h, double& t) const {
    const double upper = stop_.parameters().upper;
    ScalarMotion m{upper, speed};
    t = 0.0;
    for (ScalarMotion next = step(m, h); next.z > upper; next = step(m, h)) {
      m = next;
      t += h;
    }
    double low = 0.0;
    double high = h;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (step(m, middle).z > upper ? low : high) = middle;
    }
    t += low;
    return step(m, low);
  }

 private:
  [[nodiscard]] ScalarMotion rate(const ScalarMotion& m) const {
    return {m.rate, stop_.evaluate(m).force / mass_};
  }
  static ScalarMotion add(const ScalarMotion& m, double h,
                          const ScalarMotion& rate) {
    return {m.z + h * rate.z, m.rate + h * rate.rate};
  }

  EndStop stop_;
  double mass_;
};

EndStop make_stop(double stiffness, double damping) {
  return EndStop({.lower = -1.0,
                  .upper = 0.25,
                  .stiffness = stiffness,
                  .damping = damping});
}

TEST(EndStop, AFreeBodyLeavesWithTheRestitutionAskedFor) {
  testing::Margin margin;
  for (const double e : {0.1, 0.3, 0.5, 0.8, 0.95, 1.0}) {
    for (const double speed : {0.02, 1.7}) {
      for (const double mass : {0.5, 20.0}) {
        for (const double stiffness : {1e3, 4e6}) {
          const EndStop stop =
              make_stop(stiffness, find_stop_damping(e, speed));
          const double h = 1e-3 * std::sqrt(mass / stiffness);
          double t = 0.0;
          const ScalarMotion m = Bounce(stop, mass).run(speed, h, t);
          margin.add(std::abs(m.rate / (e * speed) + 1.0), 1.0);
        }
      }
    }
  }
  margin.expect_below(1e-6);
}

TEST(EndStop, WithoutDampingItTouchesForHalfAPeriod) {
  double t = 0.0;
  const Bounce bounce(make_stop(400.0, 0.0), 4.0);
  static_cast<void>(bounce.run(0.3, 1e-4, t));
  EXPECT_NEAR(t, std::numbers::pi / 10.0, 1e-9);
}

TEST(EndStop, ASlowerBodyLosesLess) {
  const EndStop stop = make_stop(1e4, find_stop_damping(0.5, 2.0));
  double t = 0.0;
  const ScalarMotion m = Bounce(stop, 1.0).run(0.2, 1e-5, t);
  EXPECT_GT(-m.rate / 0.2, 0.85);
  EXPECT_LT(-m.rate / 0.2, 1.0);
}

// e = 1 - 2 beta / 3 + ... for small beta, the loss of half a sine.
TEST(EndStop, LittleLossNeedsDampingInProportion) {
  for (const double loss : {1e-3, 1e-5}) {
    const double beta = find_stop_damping(1.0 - loss, 4.0) * 4.0;
    EXPECT_NEAR(beta, 1.5 * loss, 3.0 * loss * loss);
  }
  EXPECT_EQ(find_stop_damping(1.0, 4.0), 0.0);
}

TEST(EndStop, NoForceAtFirstTouchAndNoneThatPulls) {
  const EndStop stop = make_stop(1e4, 2.0);
  EXPECT_EQ(stop.evaluate({0.25, 5.0}).force, 0.0);
  EXPECT_EQ(stop.evaluate({0.3, -0.5}).force, 0.0);  // 1 + b d' = 0
  EXPECT_EQ(stop.evaluate({0.3, -4.0}).force, 0.0);
  EXPECT_LT(stop.evaluate({0.3, -0.4}).force, 0.0);
}

TEST(EndStop, BothSidesPressBackIntoTheRange) {
  const EndStop stop = make_stop(1e4, 2.0);
  EXPECT_NEAR(stop.evaluate({0.35, 0.1}).force, -1200.0, 1e-9);
  EXPECT_NEAR(stop.evaluate({-1.1, -0.1}).force, 1200.0, 1e-9);
  EXPECT_NEAR(stop.evaluate({-1.1, -0.1}).energy, 50.0, 1e-10);
  EXPECT_EQ(stop.evaluate({0.0, 9.0}).force, 0.0);
}

// So that the law has no corner within a step.
TEST(EndStop, AStopHeldOnGoesOnWhereItIsLeft) {
  const EndStop stop = make_stop(1e4, 2.0);
  const SwitchModes upper{SwitchMode::on, SwitchMode::off};
  const SwitchModes lower{SwitchMode::off, SwitchMode::on};
  EXPECT_NEAR(stop.evaluate({0.24, -0.1}, upper).force, 80.0, 1e-10);
  EXPECT_NEAR(stop.evaluate({0.24, -0.1}, upper).energy, 0.5, 1e-12);
  EXPECT_NEAR(stop.evaluate({0.24, -0.1}, upper).stiffness, 8e3, 1e-9);
  EXPECT_NEAR(stop.evaluate({-0.99, 0.1}, lower).force, -80.0, 1e-10);
}

TEST(EndStop, ItsSwitchesArePositiveWhileItTouches) {
  const double k = 100.0;
  const EndStop both = make_stop(k, 0.0);
  ASSERT_EQ(both.switch_count(), 2);
  const ScalarMotion m{3.0, 0.5};
  EXPECT_EQ(both.find_switch(0, m).value, 2.75);
  EXPECT_EQ(both.find_switch(0, m).rate, 0.5);
  EXPECT_EQ(both.find_switch(1, m).value, -4.0);
  EXPECT_EQ(both.find_switch(1, m).rate, -0.5);
  const EndStop lower({.lower = -1.0, .stiffness = k});
  EXPECT_LT(lower.find_switch(0, {1e300, 0.5}).value, 0.0);
}

}  // namespace
}  // namespace limber::joints::end_stop_test
