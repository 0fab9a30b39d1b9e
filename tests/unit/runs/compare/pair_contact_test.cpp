// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/compare/pair_contact.hpp"

#include <gtest/gtest.h>

namespace limber::runs::pair_contact_test {
namespace {

dynamics::ContactRecord make_record(const std::string& pair, double impulse,
                                    double peak, double parting) {
  dynamics::ContactRecord record;
  record.pair = pair;
  record.touches = 2;
  record.impulse = impulse;
  record.peak_force = peak;
  record.duration = 0.5;
  record.touch_speed = record.approach_speed = 1.0;
  record.parting_speed = parting;
  record.has_parted = true;
  return record;
}

// Impulses and durations add up, forces do not.
TEST(PairContact, SumsUpTheImpactsOfAPair) {
  const auto sums = sum_up({make_record("a/b", 1.0, 7.0, 0.1),
                            make_record("c/d", 9.0, 1.0, 0.9),
                            make_record("a/b", 3.0, 5.0, 0.4)});
  ASSERT_EQ(sums.size(), 2U);
  EXPECT_EQ(sums[0].pair, "a/b");
  EXPECT_EQ(sums[0].impacts, 2);
  EXPECT_EQ(sums[0].touches, 4);
  EXPECT_EQ(sums[0].impulse, 4.0);
  EXPECT_EQ(sums[0].peak_force, 7.0);
  EXPECT_EQ(sums[0].duration, 1.0);
  EXPECT_EQ(sums[0].restitution, 0.4);  // of the stronger
  EXPECT_EQ(sums[1].impulse, 9.0);
}

TEST(PairContact, RelatesToTheReference) {
  const PairContact truth{"a/b", 1, 1, 2.0, 10.0, 0.5, 0.8};
  const PairContact run{"a/b", 1, 1, 2.5, 9.0, 0.5, 0.7};
  const ContactDifference d = find_difference(run, truth);
  EXPECT_NEAR(*d.impulse, 0.25, 1e-15);
  EXPECT_NEAR(*d.peak_force, -0.1, 1e-15);
  EXPECT_EQ(*d.duration, 0.0);
  EXPECT_NEAR(*d.restitution, -0.1, 1e-15);
  EXPECT_FALSE(find_difference(run, PairContact{}).impulse);
  EXPECT_FALSE(find_difference(run, PairContact{}).restitution);
}

}  // namespace
}  // namespace limber::runs::pair_contact_test
