// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/reports/event_report.hpp"

#include <gmock/gmock.h>

namespace limber::app::event_report_test {
namespace {

using dynamics::Event;
using ::testing::EndsWith;
using ::testing::IsEmpty;
using ::testing::Not;

std::vector<Event> make_events(int count) {
  std::vector<Event> events;
  for (int i = 0; i < count; ++i) {
    const bool reached = i % 2 == 0;
    events.push_back({0.5 * i, reached ? "elbow" : "wrist",
                      reached ? "stop reached" : "stop left", 1.0 + i});
  }
  return events;
}

TEST(EventReport, JsonHoldsEveryEvent) {
  const Json json = to_json(make_events(30));
  ASSERT_EQ(json.size(), 30U);
  EXPECT_EQ(json[3]["time"], 1.5);
  EXPECT_EQ(json[3]["source"], "wrist");
  EXPECT_EQ(json[3]["what"], "stop left");
  EXPECT_EQ(json[3]["rate"], 4.0);
}

TEST(EventReport, TextHasALineAnEvent) {
  EXPECT_EQ(to_text(std::vector<Event>{}), "");
  EXPECT_EQ(to_text(std::vector<Event>{{0.25, "push", "load edge", 0.0},
                                       {0.5, "elbow", "stop reached", 1.25}}),
            "events  2\n  0.25 s 'push' load edge\n"
            "  0.5 s 'elbow' stop reached, rate 1.25\n");
}

TEST(EventReport, TextOfManyEventsCountsThemByKind) {
  EXPECT_EQ(to_text(make_events(13)),
            "events  13\n"
            "  7 stop reached, first 0 s 'elbow', last 6 s 'elbow'\n"
            "  6 stop left, first 0.5 s 'wrist', last 5.5 s 'wrist'\n");
}

TEST(EventReport, MarksEventsOfThePictureUnlessThereAreTooMany) {
  const auto marks = make_marks(make_events(4), 0.5, 1.4);
  ASSERT_EQ(marks.size(), 2U);
  EXPECT_EQ(marks[0].time, 0.5);
  EXPECT_EQ(marks[0].label, "wrist stop left");
  EXPECT_THAT(make_marks(make_events(12), 0.0, 6.0), Not(IsEmpty()));
  EXPECT_THAT(make_marks(make_events(13), 0.0, 6.0), IsEmpty());
}

TEST(EventReport, EventsAtOneTimeShareAMark) {
  std::vector<Event> events = {{1.0, "a", "latched", 0.0},
                               {1.001, "b", "latched", 0.0}};
  const auto marks = make_marks(events, 0.0, 2.0);
  ASSERT_EQ(marks.size(), 1U);
  EXPECT_EQ(marks[0].label, "a latched, b latched");
  for (int i = 0; i < 9; ++i) events.push_back({1.002, "c", "latched", 0.0});
  const std::string label = make_marks(events, 0.0, 2.0).at(0).label;
  EXPECT_THAT(label, EndsWith("c latched, ..."));
  EXPECT_LT(label.size(), 60U);
}

}  // namespace
}  // namespace limber::app::event_report_test
