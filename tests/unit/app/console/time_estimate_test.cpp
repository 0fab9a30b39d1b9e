// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/console/time_estimate.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limber/runs/numbered_stages.hpp"

namespace limber::app::time_estimate_test {
namespace {

using ::testing::HasSubstr;

/// Announcement of work at a constant rate for `total` seconds, reported every
/// 0.1 s until `end`.
std::string follow(TimeEstimate& estimate, const std::string& what,
                   double total, double end, double begin = 0.0) {
  std::string said;
  for (int i = 0; 0.1 * i <= end; ++i) {
    estimate.note(what, 0.1 * i / total, begin + 0.1 * i);
    said += estimate.take_announcement();
  }
  return said;
}

TEST(TimeEstimate, TellsWorkOfMoreThanAMinuteOnceAfterItsFirstSeconds) {
  TimeEstimate estimate;
  EXPECT_EQ(follow(estimate, "simulating", 600.0, 1.9), "");
  const std::string said = follow(estimate, "simulating", 600.0, 300.0);
  EXPECT_EQ(said,
            "simulating: about 10 min remaining, estimated from its first 2 s");
  ASSERT_TRUE(estimate.left());
  EXPECT_NEAR(*estimate.left(), 300.0, 1.0);
}

TEST(TimeEstimate, SaysNothingOfShorterWork) {
  TimeEstimate estimate;
  EXPECT_EQ(follow(estimate, "simulating", 55.0, 55.0), "");
}

TEST(TimeEstimate, TellsEachWorkApart) {
  TimeEstimate estimate;
  EXPECT_EQ(follow(estimate, "assembling", 10.0, 10.0), "");
  EXPECT_THAT(follow(estimate, "simulating", 7200.0, 5.0, 10.0),
              HasSubstr("about 2.0 h remaining"));
}

// The rate may change: after a restart it is measured from there.
TEST(TimeEstimate, GoesByTheRateSinceTheWorkBegan) {
  TimeEstimate estimate;
  estimate.note("all 2 runs", 0.5, 100.0);
  EXPECT_FALSE(estimate.left());
  estimate.note("all 2 runs", 0.6, 110.0);
  ASSERT_TRUE(estimate.left());
  EXPECT_NEAR(*estimate.left(), 40.0, 1e-9);
  estimate.note("all 2 runs", 0.0, 120.0);  // restarted
  EXPECT_FALSE(estimate.left());
}

TEST(TimeEstimate, AnnouncesAStatedDurationOnceAndNothingForShortWork) {
  TimeEstimate estimate;
  estimate.note(with_duration("factorising", 59.0), 0.0, 1.0);
  EXPECT_EQ(estimate.take_announcement(), "");
  estimate.note(with_duration("factorising", 300.0), 0.0, 1.0);
  EXPECT_EQ(estimate.take_announcement(), "factorising, about 5 min");
  estimate.note(with_duration("factorising", 300.0), 0.0, 2.0);
  EXPECT_EQ(estimate.take_announcement(), "");
}

TEST(NumberedStage, PutsItsNumberBeforeTheTask) {
  std::string said;
  const Progress bar = [&](std::string_view what, double fraction) {
    said += fmt::format("{}: {}\n", what, fraction);
  };
  runs::number_stage(bar, 1, 2)(with_duration("factorising", 300.0), 0.25);
  runs::number_stage(bar, 2, 2)("simulating", 0.5);
  EXPECT_EQ(
      said,
      "1 of 2, factorising, about 5 min: 0.25\n2 of 2, simulating: 0.5\n");
}

TEST(TimeEstimate, WritesDurationsAsOneSaysThem) {
  EXPECT_EQ(to_duration(75.4), "75 s");
  EXPECT_EQ(to_duration(720.0), "12 min");
  EXPECT_EQ(to_duration(3.4 * 3600.0), "3.4 h");
  EXPECT_EQ(to_duration(72.0 * 3600.0), "3 days");
}

}  // namespace
}  // namespace limber::app::time_estimate_test
