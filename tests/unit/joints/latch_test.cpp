// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/latch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "limber/common/rotation.hpp"
#include "support/differences.hpp"
#include "unit/joints/coupler_cases.hpp"

namespace limber::joints::latch_test {
namespace {

using testing::carried;
using testing::differentiate;
using testing::random_motion;

Latch::Parameters parameters() {
  return {.reach = 0.1,
          .bushing = {.translational_stiffness =
                          Vector3(100.0, 200.0, 400.0).asDiagonal(),
                      .rotational_stiffness = 30.0 * Matrix3::Identity(),
                      .translational_damping = 2.0 * Matrix3::Identity()},
          .release_force = 50.0,
          .release_time = 4.0};
}

RelativeMotion at(const Vector3& p) {
  RelativeMotion motion;
  motion.R_FM = exp_rotation(Vector3(0.5, -1.0, 2.0));
  motion.p_FM_F = p;
  return motion;
}

CouplerMemory closed_at(const RelativeMotion& motion) {
  CouplerMemory memory;
  Latch(parameters()).update(0, motion, memory);
  return memory;
}

TEST(Latch, IsNotThereWhileItIsOpenOrReleased) {
  const Latch latch(parameters());
  CouplerMemory memory;
  const RelativeMotion near = at(Vector3(0.0, 0.01, 0.0));
  EXPECT_EQ(latch.evaluate(near, memory).wrench.norm(), 0.0);
  memory.latch = LatchStatus::released;
  EXPECT_EQ(latch.evaluate(near, memory).wrench.norm(), 0.0);
  EXPECT_EQ(latch.evaluate(near, memory).stiffness.norm(), 0.0);
}

TEST(Latch, ClosesWhereTheDistanceFallsToItsReach) {
  const Latch latch(parameters());
  RelativeMotion motion = at(Vector3(0.0, 0.12, 0.16));
  motion.v_FM_F = Vector3(5.0, -1.0, 0.0);
  const SwitchValue value = latch.find_switch(0, motion, {}, 0.0);
  EXPECT_NEAR(value.value, 0.5 * (0.1 - 0.04 / 0.1), 1e-15);
  EXPECT_NEAR(value.rate, 0.12 / 0.1, 1e-15);
  EXPECT_GT(latch.find_switch(0, at(Vector3(0.05, 0.05, 0.05)), {}, 0.0).value,
            0.0);
}

TEST(Latch, RestsInThePoseInWhichItCaught) {
  const Latch latch(parameters());
  const RelativeMotion caught = at(Vector3(0.06, 0.08, 0.0));
  const CouplerMemory memory = closed_at(caught);
  EXPECT_EQ(memory.latch, LatchStatus::closed);
  EXPECT_EQ(memory.X_FM.R, caught.R_FM);
  EXPECT_EQ(memory.X_FM.p, caught.p_FM_F);
  EXPECT_LT(latch.evaluate(caught, memory).wrench.norm(), 1e-13);
  EXPECT_LT(latch.evaluate(caught, memory).energy, 1e-15);
  const RelativeMotion pulled = at(Vector3(0.06, 0.08, 0.01));
  EXPECT_NEAR(latch.evaluate(pulled, memory).wrench[2], -4.0, 1e-13);
}

TEST(Latch, GivesWayWhereItsSpringExceedsTheForce) {
  const Latch latch(parameters());
  const RelativeMotion caught = at(Vector3(0.06, 0.08, 0.0));
  const CouplerMemory memory = closed_at(caught);
  EXPECT_EQ(latch.find_switch(0, caught, memory, 0.0).value, -25.0);
  // 30 N along x and 40 N along y; the damper does not count.
  RelativeMotion pulled = at(Vector3(0.36, 0.28, 0.0));
  pulled.v_FM_F = Vector3(1.0, 0.0, 0.0);
  const SwitchValue value = latch.find_switch(0, pulled, memory, 0.0);
  EXPECT_NEAR(value.value, 0.0, 1e-13);
  EXPECT_NEAR(value.rate, 60.0, 1e-12);
}

TEST(Latch, ReleasesAtItsTimeOpenOrClosed) {
  const Latch latch(parameters());
  const RelativeMotion motion = at(Vector3(0.06, 0.08, 0.0));
  for (const CouplerMemory& memory : {CouplerMemory{}, closed_at(motion)}) {
    EXPECT_EQ(latch.find_switch(1, motion, memory, 3.0).value, -1.0);
    EXPECT_EQ(latch.find_switch(1, motion, memory, 4.5).value, 0.5);
    EXPECT_EQ(latch.find_switch(1, motion, memory, 4.5).rate, 1.0);
    CouplerMemory after = memory;
    latch.update(1, motion, after);
    EXPECT_EQ(after.latch, LatchStatus::released);
  }
}

TEST(Latch, NeverClosesAgain) {
  const Latch latch(parameters());
  const RelativeMotion motion = at(Vector3(0.06, 0.08, 0.0));
  CouplerMemory memory = closed_at(motion);
  latch.update(0, motion, memory);
  EXPECT_EQ(memory.latch, LatchStatus::released);
  // At zero distance, and where a closed one would open again.
  for (const RelativeMotion& m :
       {at(Vector3::Zero()), at(Vector3(9., 0., 0.))}) {
    for (const int index : {0, 1}) {
      EXPECT_LT(latch.find_switch(index, m, memory, 100.0).value, 0.0);
    }
  }
  latch.update(0, motion, memory);
  EXPECT_EQ(memory.latch, LatchStatus::released);
}

TEST(Latch, WithoutReleaseItHoldsForEver) {
  const Latch latch({.reach = 0.1, .bushing = parameters().bushing});
  const RelativeMotion caught = at(Vector3(0.06, 0.08, 0.0));
  const CouplerMemory memory = closed_at(caught);
  const RelativeMotion far = at(Vector3(1e6, 0.0, 0.0));
  EXPECT_LT(latch.find_switch(0, far, memory, 1e9).value, 0.0);
  EXPECT_LT(latch.find_switch(1, far, memory, 1e9).value, 0.0);
}

TEST(Latch, SwitchRatesAreDerivativesByTime) {
  const Latch latch(parameters());
  std::mt19937 random(4);
  testing::Margin margin;
  for (int trial = 0; trial < 50; ++trial) {
    const RelativeMotion motion = random_motion(JointKind::floating, random);
    const RelativeMotion other = random_motion(JointKind::fixed, random);
    for (const CouplerMemory& memory : {CouplerMemory{}, closed_at(other)}) {
      for (const int index : {0, 1}) {
        const double rate = differentiate([&](double by) {
          return latch.find_switch(index, carried(motion, by), memory, 1.0 + by)
              .value;
        });
        const double rate_found =
            latch.find_switch(index, motion, memory, 1.0).rate;
        margin.add(std::abs(rate_found - rate), std::abs(rate_found));
      }
    }
  }
  margin.expect_below(1e-9);
}

}  // namespace
}  // namespace limber::joints::latch_test
