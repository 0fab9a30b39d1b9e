// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/charts/label_placement.hpp"

#include <gtest/gtest.h>

namespace limber::results::label_placement_test {
namespace {

TEST(LabelPlacement, PutsALabelToTheRightUnlessTheEdgeIsNear) {
  const auto places = place_labels(
      {{50.0, 50.0, "left"}, {395.0, 50.0, "right"}}, 400.0, 100.0);
  ASSERT_TRUE(places[0] && places[1]);
  EXPECT_TRUE(places[0]->reaches_right);
  EXPECT_GT(places[0]->x, 50.0);
  EXPECT_FALSE(places[1]->reaches_right);
  EXPECT_LT(places[1]->x, 395.0);
}

TEST(LabelPlacement, LeavesOutWhatWouldCoverAnother) {
  const std::vector<LabelledPoint> crowd(6, {200.0, 50.0, "a label"});
  const auto places = place_labels(crowd, 400.0, 100.0);
  int count = 0;
  for (const auto& place : places) count += place ? 1 : 0;
  EXPECT_EQ(count, 4);  // one in each corner
  EXPECT_TRUE(places[0]);
}

TEST(LabelPlacement, KeepsOffLines) {
  const std::vector<LabelledPoint> point = {{200.0, 50.0, "label"}};
  const auto free = place_labels(point, 400.0, 100.0);
  const auto lined = place_labels(point, 400.0, 100.0, {58.0});
  ASSERT_TRUE(free[0] && lined[0]);
  EXPECT_GT(free[0]->y, 50.0);
  EXPECT_LT(lined[0]->y, 50.0);
}

TEST(LabelPlacement, GivesNoPlaceToNoText) {
  EXPECT_FALSE(place_labels({{200.0, 50.0, ""}}, 400.0, 100.0)[0]);
}

}  // namespace
}  // namespace limber::results::label_placement_test
