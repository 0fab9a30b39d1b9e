// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/oscillation.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "limber/joints/scalar/drive.hpp"
#include "support/sliding_masses.hpp"

namespace limber::dynamics::oscillation_test {
namespace {

using joints::Drive;
using joints::SineSignal;

Drive make_drive(const joints::Signal& signal) {
  return Drive({.mode = joints::DriveMode::position,
                .signal = signal,
                .stiffness = 10.0});
}

// A mass on a rail, whose drive follows a signal.
SystemBuilder make_driven(const joints::Signal& signal) {
  SystemBuilder builder;
  const testing::Mass mass = testing::add_mass(builder, "mass", 2.0);
  testing::add_rail(builder, mass, "rail",
                    {{.coordinate = 0, .law = make_drive(signal)}});
  return builder;
}

SystemModel make_pushed(const TimeFunction& function) {
  SystemBuilder builder;
  const testing::Mass mass = testing::add_mass(builder, "mass", 2.0);
  builder.add_load("push", mass.frame, {1.0, 0.0, 0.0}, Vector3::Zero(),
                   LoadFrame::world, function);
  return builder.build();
}

TEST(Oscillations, AreThoseOfSinusoidsWhileTheyAct) {
  const auto found = find_oscillations(make_pushed(
      Sinusoid{.frequency = 5.0, .phase = 1.0, .from = 0.5, .until = 0.8}));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].name, "load 'push'");
  EXPECT_DOUBLE_EQ(found[0].period, 0.2);
  EXPECT_EQ(find_fastest(found, 0.4), nullptr);
  EXPECT_EQ(find_fastest(found, 0.6), &found[0]);
  EXPECT_EQ(find_fastest(found, 0.9), nullptr);
}

TEST(Oscillations, AreFastestByTheShortestPeriodAtATime) {
  const std::vector<Oscillation> all = {
      {"a", 0.2, 0.0, 1.0}, {"b", 0.1, 0.5, 1.0}, {"c", 0.3, 0.0, kNever}};
  EXPECT_EQ(find_fastest(all, 0.1), &all[0]);
  EXPECT_EQ(find_fastest(all, 0.7), &all[1]);
  EXPECT_EQ(find_fastest(all, 2.0), &all[2]);
}

TEST(Oscillations, OfASumHaveThePeriodOfItsFastestTermThatIsNotZero) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const auto found = find_oscillations(
      make_pushed(HarmonicSum{.mean = 1.0,
                              .terms = {{.omega = 0.0, .cosine = 1.0},
                                        {.omega = 3.0 * kTurn, .sine = 0.1},
                                        {.omega = 2.0 * kTurn, .cosine = 5.0},
                                        {.omega = 50.0 * kTurn}}}));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].period, 1.0 / 3.0, 1e-15);
}

TEST(Oscillations, AreNoneOfConstantsPulsesAndTables) {
  for (const TimeFunction& function :
       {TimeFunction(Constant{}), TimeFunction(Pulse{.duration = 1.0}),
        TimeFunction(Table{{0.0, 1.0}, {0.0, 1.0}}), TimeFunction(Sinusoid{}),
        TimeFunction(HarmonicSum{.mean = 1.0})}) {
    EXPECT_TRUE(find_oscillations(make_pushed(function)).empty())
        << function.index();
  }
}

TEST(Oscillations, OfASineThatADriveFollowsBeginWithTheShapersFirstImpulse) {
  const auto found = find_oscillations(
      make_driven(
          {.base = SineSignal{.amplitude = 0.1, .frequency = 4.0, .start = 0.5},
           .shaper = {{0.5, 0.2}, {0.5, 0.1}}})
          .build());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].name, "the drive of 'rail'");
  EXPECT_DOUBLE_EQ(found[0].period, 0.25);
  EXPECT_DOUBLE_EQ(found[0].from, 0.6);
  EXPECT_EQ(found[0].until, kNever);
}

TEST(Oscillations, AreNoneOfARampOrASineWithoutAmplitude) {
  for (const auto& signal :
       {joints::Signal{joints::RampSignal{.to = 1.0, .duration = 1.0}},
        joints::Signal{SineSignal{.mean = 1.0, .frequency = 4.0}}}) {
    EXPECT_TRUE(find_oscillations(make_driven(signal).build()).empty());
  }
}

TEST(Oscillations, AreThoseOfTransmissionsToo) {
  SystemBuilder builder;
  const testing::Mass mass = testing::add_mass(builder, "mass", 2.0);
  const CouplerIndex rail = testing::add_rail(builder, mass, "rail");
  builder.add_joint_sum(
      "gear", JointSum{.terms = {{rail, 0, 1.0}}},
      {make_drive({SineSignal{.amplitude = 0.1, .frequency = 8.0}})});
  const auto found = find_oscillations(builder.build());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].name, "the drive of 'gear'");
  EXPECT_DOUBLE_EQ(found[0].period, 0.125);
}

}  // namespace
}  // namespace limber::dynamics::oscillation_test
