// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/scalar/drive.hpp"

#include <gtest/gtest.h>

namespace limber::joints::drive_test {
namespace {

constexpr EvaluationTime kNow{0.5};

Drive::Parameters position() {
  return {.mode = DriveMode::position,
          .signal = {ConstantSignal{2.0}},
          .stiffness = 100.0,
          .damping = 6.0,
          .max_effort = 30.0};
}

// Below 0.3 rad of error k e^2 / 2, above it Fmax (e - Fmax / (2 k)).
TEST(Drive, ALimitedPositionDriveStoresHubersEnergy) {
  const Drive drive(position());
  for (const double sign : {-1.0, 1.0}) {
    const ScalarResponse near = drive.evaluate({2.0 + sign * 0.2, 0.0}, kNow);
    EXPECT_NEAR(near.energy, 2.0, 1e-13);
    EXPECT_NEAR(near.force, -sign * 20.0, 1e-13);
    EXPECT_EQ(near.stiffness, 100.0);
    const ScalarResponse far = drive.evaluate({2.0 + sign * 1.3, 0.0}, kNow);
    EXPECT_NEAR(far.energy, 30.0 * (1.3 - 0.15), 1e-13);
    EXPECT_EQ(far.force, -sign * 30.0);
    EXPECT_EQ(far.stiffness, 0.0);
    EXPECT_EQ(far.damping, 0.0);
  }
}

TEST(Drive, TheDamperOfALimitedDriveDissipatesWhatPassesTheLimit) {
  const Drive drive(position());
  // Spring 20 N, damper 6 N s/m 1 m/s = 6 N: 26 N, within the limit.
  EXPECT_NEAR(drive.evaluate({2.2, 1.0}, kNow).dissipation, 6.0, 1e-13);
  // Damper 30 N: cut to the 10 N that are left.
  EXPECT_NEAR(drive.evaluate({2.2, 5.0}, kNow).dissipation, 50.0, 1e-12);
  // The spring alone is at its limit; the damper relieves it.
  EXPECT_EQ(drive.evaluate({3.0, 5.0}, kNow).dissipation, 0.0);
  EXPECT_EQ(drive.evaluate({3.0, -5.0}, kNow).dissipation, 0.0);
  EXPECT_NEAR(drive.evaluate({2.4, -5.0}, kNow).dissipation, 100.0, 1e-12);
}

TEST(Drive, ADriveThatOnlyPullsIsSlackBeyondItsCommand) {
  Drive::Parameters p = position();
  p.pulls_only = true;
  const Drive drive(p);
  EXPECT_NEAR(drive.evaluate({2.2, 0.0}, kNow).force, -20.0, 1e-13);
  EXPECT_EQ(drive.evaluate({1.8, 0.0}, kNow).force, 0.0);
  EXPECT_EQ(drive.evaluate({1.8, 0.0}, kNow).energy, 0.0);
  EXPECT_NEAR(drive.evaluate({3.3, 0.0}, kNow).energy, 34.5, 1e-13);
}

TEST(Drive, AVelocityDriveIsADamperToItsCommand) {
  const Drive drive({.mode = DriveMode::velocity,
                     .signal = {ConstantSignal{2.0}},
                     .damping = 6.0,
                     .max_effort = 9.0});
  const ScalarResponse at = drive.evaluate({7.0, 1.0}, kNow);
  EXPECT_EQ(at.force, 6.0);
  EXPECT_EQ(at.supplied, 12.0);
  EXPECT_EQ(at.dissipation, 6.0);
  EXPECT_EQ(at.energy, 0.0);
  EXPECT_EQ(drive.evaluate({7.0, -1.0}, kNow).force, 9.0);
}

TEST(Drive, AnEffortFallsToZeroJustAboveTheSpeedLimit) {
  for (const double effort : {-8.0, 8.0}) {
    const double sign = effort > 0.0 ? 1.0 : -1.0;
    const Drive drive({.mode = DriveMode::effort,
                       .signal = {ConstantSignal{effort}},
                       .max_speed = 2.0});
    const auto force = [&](double speed) {
      return drive.evaluate({0.0, sign * speed}, kNow).force;
    };
    EXPECT_EQ(force(0.0), effort);
    EXPECT_EQ(force(2.0), effort);
    EXPECT_NEAR(force(2.05), 0.75 * effort, 1e-12);
    EXPECT_NEAR(force(2.1), 0.5 * effort, 1e-12);
    EXPECT_NEAR(force(2.2), 0.0, 1e-12);
    EXPECT_EQ(force(5.0), 0.0);
    EXPECT_EQ(force(-5.0), effort);  // a brake has no such limit
    // 8 N over 0.2 m/s.
    EXPECT_NEAR(drive.evaluate({0.0, sign * 2.1}, kNow).damping, 40.0, 1e-11);
  }
}

TEST(Drive, AnEffortThatOnlyPullsShortens) {
  const Drive pull({.mode = DriveMode::effort,
                    .signal = {ConstantSignal{8.0}},
                    .pulls_only = true});
  EXPECT_EQ(pull.evaluate({0.0, 1.0}, kNow).force, -8.0);
  EXPECT_EQ(pull.evaluate({0.0, 1.0}, kNow).supplied, -8.0);
  const Drive push({.mode = DriveMode::effort,
                    .signal = {ConstantSignal{-8.0}},
                    .pulls_only = true});
  EXPECT_EQ(push.evaluate({0.0, 1.0}, kNow).force, 0.0);
}

TEST(Drive, ACommandAtItsLimitIsTaken) {
  const RampSignal ramp{.to = 3.0, .duration = 2.0};
  EXPECT_NO_THROW(
      Drive({.signal = {ramp}, .stiffness = 1.0, .max_speed = 1.5}));
  EXPECT_NO_THROW(Drive({.mode = DriveMode::effort,
                         .signal = {ConstantSignal{-8.0}},
                         .max_effort = 8.0}));
}

TEST(Drive, AnEffortCommandsNoSpeed) {
  EXPECT_NO_THROW(Drive({.mode = DriveMode::effort,
                         .signal = {ConstantSignal{8.0}},
                         .max_speed = 1e-3}));
}

}  // namespace
}  // namespace limber::joints::drive_test
