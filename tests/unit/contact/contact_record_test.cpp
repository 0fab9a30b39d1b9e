// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "unit/contact/ball_on_floor.hpp"

/// What a run records of an impact, against Hertz's theory (Johnson 1985,
/// sec. 11.4).
namespace limber::contact::contact_record_test {
namespace {

class ContactRecordFrom : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Time, ContactRecordFrom,
                         ::testing::Values(0.0, 1000.0));

TEST_P(ContactRecordFrom, ABallOnAFloorIsHertzs) {
  constexpr double kSpeed = 1.0;
  const double start = GetParam();
  test::BallOnFloor scene({}, {0.0, 0.0, -kSpeed});
  scene.state.t = start;
  dynamics::SimulationSettings settings;
  settings.end_time = start + 2e-4;
  settings.step = 1e-7;
  dynamics::SimulationStatistics statistics;
  dynamics::RunRecord record;
  dynamics::simulate(scene.model, scene.state, settings, {}, {}, statistics, {},
                     {}, record);
  ASSERT_FALSE(statistics.events.empty());
  EXPECT_NEAR(statistics.events[0].time - start, 1e-6 / kSpeed, 1e-9);
  const double k = test::hertz_stiffness();
  const double depth =
      std::pow(1.25 * test::kBallMass * kSpeed * kSpeed / k, 0.4);
  const double force = k * std::pow(depth, 1.5);
  const double duration = 2.9432 * depth / kSpeed;
  ASSERT_EQ(record.contacts.size(), 1U);
  const dynamics::ContactRecord& contact = record.contacts[0];
  constexpr double kSame = 2e-3;
  EXPECT_EQ(contact.pair, "floor/ball");
  EXPECT_TRUE(contact.has_parted);
  EXPECT_NEAR(contact.time - start, 1e-6 / kSpeed, 2e-7);
  EXPECT_NEAR(contact.duration / duration, 1.0, 0.01);
  EXPECT_NEAR(contact.peak_force / force, 1.0, kSame);
  EXPECT_NEAR(contact.peak_time - start, 1e-6 / kSpeed + 0.5 * duration,
              0.01 * duration);
  EXPECT_NEAR(contact.peak_depth / depth, 1.0, kSame);
  EXPECT_NEAR(contact.peak_depth_over_radius / (depth / test::kBallRadius), 1.0,
              kSame);
  EXPECT_NEAR(contact.impulse / (2.0 * test::kBallMass * kSpeed), 1.0, kSame);
  EXPECT_NEAR(contact.parting_speed / kSpeed, 1.0, kSame);
}

}  // namespace
}  // namespace limber::contact::contact_record_test
