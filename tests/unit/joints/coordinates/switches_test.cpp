// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/coordinates/switches.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/joints/coupler_law.hpp"
#include "limber/joints/joint_kind.hpp"
#include "support/differences.hpp"
#include "unit/joints/coupler_cases.hpp"

namespace limber::joints::switches_test {
namespace {

using testing::carried;
using testing::differentiate;

const Vector3 kAxis = Vector3(2.0, -1.0, 2.0) / 3.0;

EndStop stop() {
  return EndStop({.lower = -0.5, .upper = 11.0, .stiffness = 100.0});
}

ScalarSpring line() {
  return ScalarSpring({.curve = SpringCurve({.stiffness = 10.0}),
                       .rest = 0.4,
                       .tension_only = true});
}

// Friction has no switch, the line one, the stop two.
CouplerLaw planar() {
  return make_joint(JointKind::planar, kAxis, {}, {},
                    {{0, Friction({.viscous = 1.0})},
                     {1, line()},
                     {2, stop()},
                     {0, ScalarSpring({.damping = 1.0})}});
}

CouplerLaw rope() {
  return PointSpring(
      {.stiffness = 10.0, .free_length = 0.7, .tension_only = true});
}

CouplerLaw latch() { return Latch({.reach = 0.1, .release_time = 2.0}); }

TEST(Switches, AreThoseOfTheLawsThatHaveThem) {
  EXPECT_EQ(switch_count(planar()), 3);
  EXPECT_EQ(switch_count(rope()), 1);
  EXPECT_EQ(switch_count(CouplerLaw(PointSpring({.stiffness = 1.0}))), 0);
  EXPECT_EQ(switch_count(CouplerLaw(Bushing({}))), 0);
  EXPECT_EQ(switch_count(latch()), 2);
}

TEST(Switches, ArePositiveWhileTautOrTouching) {
  const auto [x, y] = find_plane_axes(kAxis);
  RelativeMotion motion;
  motion.p_FM_F = 0.9 * y;
  motion.v_FM_F = 3.0 * y + 7.0 * x;
  motion.R_FM = exp_rotation(-0.2 * kAxis);
  motion.w_FM_F = 2.0 * kAxis;
  CouplerMemory memory;
  memory.near[2] = 4.0 * 3.141592653589793;
  // Two whole turns less 0.2 rad: 1.366 rad beyond the upper stop.
  const double angle = memory.near[2] - 0.2;
  const auto at = [&](int index) {
    return find_switch(planar(), index, motion, memory, 0.0);
  };
  EXPECT_NEAR(at(0).value, 0.5, 1e-14);
  EXPECT_NEAR(at(0).rate, 3.0, 1e-14);
  EXPECT_NEAR(at(1).value, angle - 11.0, 1e-13);
  EXPECT_NEAR(at(1).rate, 2.0, 1e-14);
  EXPECT_NEAR(at(2).value, -0.5 - angle, 1e-13);
  EXPECT_NEAR(at(2).rate, -2.0, 1e-14);
}

// Switched off, each removes only the force of its own law.
TEST(Switches, AreHeldInTheOrderInWhichTheyAreFound) {
  const Vector3 y = find_plane_axes(kAxis).y;
  RelativeMotion motion;
  motion.p_FM_F = 0.9 * y;
  motion.R_FM = exp_rotation(-0.8 * kAxis);
  for (const double turns : {0.0, 2.0}) {
    const double angle = turns * 2.0 * 3.141592653589793 - 0.8;
    CouplerMemory memory;
    memory.near[2] = angle;
    const Vector6 all = evaluate(planar(), motion, memory, {}).wrench;
    EXPECT_NEAR(all.head<3>().dot(y), -5.0, 1e-13);
    const bool is_lower = angle < 0.0;
    ASSERT_NE(is_lower, angle > 11.0);
    for (int i = 0; i < 3; ++i) {
      CouplerMemory held = memory;
      held.switches.at(static_cast<std::size_t>(i)) = SwitchMode::off;
      const Vector6 rest = evaluate(planar(), motion, held, {}).wrench;
      const bool has_line = i != 0;
      const bool has_stop = i != (is_lower ? 2 : 1);
      EXPECT_EQ(rest.head<3>().norm() > 1.0, has_line);
      EXPECT_EQ(rest.tail<3>().norm() > 1e-9, has_stop);
    }
  }
  CouplerMemory held;
  held.switches[0] = SwitchMode::off;
  RelativeMotion far;
  far.p_FM_F = Vector3(5.0, 0.0, 0.0);
  EXPECT_GT(evaluate(rope(), far, {}, {}).wrench.norm(), 1.0);
  EXPECT_EQ(evaluate(rope(), far, held, {}).wrench.norm(), 0.0);
}

TEST(Switches, ARopeIsTautAboveItsFreeLength) {
  RelativeMotion motion;
  motion.p_FM_F = Vector3(0.0, 0.6, -0.8);
  motion.v_FM_F = Vector3(9.0, 5.0, 0.0);
  EXPECT_NEAR(find_switch(rope(), 0, motion, {}, 0.0).value, 0.3, 1e-15);
  EXPECT_NEAR(find_switch(rope(), 0, motion, {}, 0.0).rate, 3.0, 1e-15);
  // Its ends meet: slack, and without a direction.
  EXPECT_EQ(find_switch(rope(), 0, {}, {}, 0.0).value, -0.7);
  EXPECT_EQ(evaluate(rope(), {}, {}, {}).wrench.norm(), 0.0);
}

TEST(Switches, RatesAreDerivativesByTime) {
  std::mt19937 random(4);
  testing::Margin margin;
  for (const CouplerLaw& law : {planar(), rope(), latch()}) {
    for (int trial = 0; trial < 50; ++trial) {
      const RelativeMotion motion =
          testing::random_motion(JointKind::floating, random);
      for (int i = 0; i < switch_count(law); ++i) {
        const double rate = differentiate([&](double by) {
          return find_switch(law, i, carried(motion, by), {}, by).value;
        });
        const double rate_found = find_switch(law, i, motion, {}, 0.0).rate;
        margin.add(std::abs(rate_found - rate), std::abs(rate_found));
      }
    }
  }
  margin.expect_below(1e-9);
}

TEST(Switches, EachTellsItsEvents) {
  const CouplerMemory open;
  CouplerMemory closed;
  closed.latch = LatchStatus::closed;
  const auto event = [](const CouplerLaw& law, int index, bool rises,
                        const CouplerMemory& memory) {
    return find_event(law, index, rises, memory);
  };
  EXPECT_EQ(event(planar(), 0, true, open), EventKind::taut);
  EXPECT_EQ(event(planar(), 0, false, open), EventKind::slack);
  for (const int index : {1, 2}) {
    EXPECT_EQ(event(planar(), index, true, open), EventKind::stop_reached);
    EXPECT_EQ(event(planar(), index, false, open), EventKind::stop_left);
  }
  EXPECT_EQ(event(rope(), 0, true, open), EventKind::taut);
  EXPECT_EQ(event(rope(), 0, false, open), EventKind::slack);
  EXPECT_EQ(event(latch(), 0, true, open), EventKind::latched);
  EXPECT_EQ(event(latch(), 0, true, closed), EventKind::released);
  EXPECT_EQ(event(latch(), 1, true, open), EventKind::released);
  EXPECT_EQ(event(latch(), 1, true, closed), EventKind::released);
  EXPECT_EQ(event(latch(), 0, false, open), std::nullopt);
  EXPECT_EQ(event(latch(), 1, false, closed), std::nullopt);
}

TEST(Switches, OnlyALatchRemembersThem) {
  RelativeMotion motion;
  motion.p_FM_F = Vector3(0.0, 0.0, 0.1);
  CouplerMemory memory;
  update_memory(planar(), 1, motion, memory);
  update_memory(rope(), 0, motion, memory);
  EXPECT_EQ(memory.latch, LatchStatus::open);
  update_memory(latch(), 0, motion, memory);
  EXPECT_EQ(memory.latch, LatchStatus::closed);
  EXPECT_EQ(memory.X_FM.p, motion.p_FM_F);
  update_memory(latch(), 1, motion, memory);
  EXPECT_EQ(memory.latch, LatchStatus::released);
}

TEST(Switches, OneThatIsNotThereIsACallersDefect) {
  for (const CouplerLaw& law :
       {planar(), rope(), latch(), CouplerLaw(Bushing({}))}) {
    for (const int index : {-1, switch_count(law)}) {
      EXPECT_THROW(static_cast<void>(find_switch(law, index, {}, {}, 0.0)),
                   ContractError);
      EXPECT_THROW(static_cast<void>(find_event(law, index, true, {})),
                   ContractError);
    }
  }
}

TEST(Switches, BreakTimesAreThoseOfTheDrives) {
  const auto drive = [](double start) {
    return Drive({.signal = {RampSignal{.start = start, .duration = 1.0}},
                  .stiffness = 1.0});
  };
  const CouplerLaw law =
      make_joint(JointKind::universal, Vector3::UnitX(), Vector3::UnitY(), {},
                 {{0, drive(2.0)}, {1, line()}, {1, drive(0.5)}});
  EXPECT_EQ(break_times(law), (std::vector<double>{2.0, 3.0, 0.5, 1.5}));
  EXPECT_TRUE(break_times(latch()).empty());
}

TEST(Switches, EachEventHasAName) {
  EXPECT_EQ(to_string(EventKind::stop_reached), "stop reached");
  EXPECT_EQ(to_string(EventKind::stop_left), "stop left");
  EXPECT_EQ(to_string(EventKind::taut), "taut");
  EXPECT_EQ(to_string(EventKind::slack), "slack");
  EXPECT_EQ(to_string(EventKind::latched), "latched");
  EXPECT_EQ(to_string(EventKind::released), "released");
}

}  // namespace
}  // namespace limber::joints::switches_test
