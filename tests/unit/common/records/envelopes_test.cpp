// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/records/envelopes.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace limber::test::envelopes_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(EnvelopeEdges, AreTheStartTheOutputsAndTheEnd) {
  EXPECT_THAT(choose_envelope_edges(0.0, {0.0, 1.0, 2.0}, 2.0),
              ElementsAre(0.0, 1.0, 2.0));
  EXPECT_THAT(choose_envelope_edges(0.5, {0.0, 1.0, 2.0}, 2.5),
              ElementsAre(0.5, 1.0, 2.0, 2.5));
  EXPECT_THAT(choose_envelope_edges(0.0, {}, 2.0), ElementsAre(0.0, 2.0));
  EXPECT_THAT(choose_envelope_edges(2.0, {}, 2.0), IsEmpty());
}

TEST(EnvelopeEdges, AreSomeOfManyOutputs) {
  for (const int count : {999, 1000, 1001, 2000, 12345}) {
    std::vector<double> outputs;
    for (int i = 0; i <= count; ++i) outputs.push_back(i);
    const auto edges = choose_envelope_edges(0.0, outputs, count);
    EXPECT_LE(edges.size(), 1001U) << count;
    EXPECT_GT(edges.size(), 500U) << count;
    EXPECT_EQ(edges.front(), 0.0);
    EXPECT_EQ(edges.back(), count);
    for (std::size_t i = 1; i < edges.size(); ++i) {
      ASSERT_GT(edges[i], edges[i - 1]);
      ASSERT_EQ(edges[i], std::round(edges[i]));  // an output
    }
  }
}

TEST(Envelopes, HoldTheSmallestAndLargestValueOfTheirIntervals) {
  Envelopes envelopes = make_envelopes({0.0, 1.0, 2.0, 3.0}, 2);
  include(envelopes, 0, 5.0, 0.0);
  include(envelopes, 0, kNan, 0.2);
  include(envelopes, 0, -7.0, 0.5);
  include(envelopes, 0, 8.0, 1.0);  // between the first and the second
  include(envelopes, 1, 4.0, 9.0);  // after the end: in the last
  EXPECT_EQ(envelopes.least(0, 0), -7.0);
  EXPECT_EQ(envelopes.most(0, 0), 8.0);
  EXPECT_EQ(envelopes.least(1, 0), 8.0);
  EXPECT_EQ(envelopes.most(1, 0), 8.0);
  EXPECT_TRUE(std::isnan(envelopes.least(2, 0)));
  EXPECT_TRUE(std::isnan(envelopes.most(0, 1)));
  EXPECT_EQ(envelopes.most(2, 1), 4.0);
}

TEST(Envelopes, WithoutIntervalsIgnoreValues) {
  Envelopes envelopes = make_envelopes({}, 3);
  include(envelopes, 2, 1.0, 0.0);
  EXPECT_TRUE(envelopes.is_empty());
}

TEST(Envelopes, ComeBackFromALog) {
  Envelopes envelopes = make_envelopes({0.0, 1.0, 2.0, 3.0}, 2);
  Archive log;
  include(envelopes, 0, 5.0, 0.5);
  write_intervals(envelopes, 0.0, 0.5, log);
  include(envelopes, 0, 6.0, 0.75);  // the second entry of the interval holds
  include(envelopes, 1, -1.0, 1.5);
  write_intervals(envelopes, 0.5, 1.5, log);
  EXPECT_EQ(log.numbers().size(), 3U * (2U + 2U * (2U + 2U)));

  Archive written(log.numbers());
  Envelopes restored = make_envelopes(envelopes.edges, 2);
  read_intervals(written, restored);
  EXPECT_EQ(restored.most(0, 0), 6.0);
  EXPECT_EQ(restored.least(0, 0), 5.0);
  EXPECT_EQ(restored.most(1, 1), -1.0);
  EXPECT_TRUE(std::isnan(restored.most(2, 0)));

  // Of other outputs only the intervals that are the same.
  Archive again(log.numbers());
  Envelopes other = make_envelopes({0.0, 1.0, 1.5, 4.0}, 2);
  read_intervals(again, other);
  EXPECT_EQ(other.most(0, 0), 6.0);
  EXPECT_TRUE(std::isnan(other.most(1, 1)));

  std::vector<double> cut = log.numbers();
  cut.resize(cut.size() - 3);
  Archive damaged(cut);
  EXPECT_THROW(read_intervals(damaged, restored), InputError);
}

}  // namespace
}  // namespace limber::test::envelopes_test
