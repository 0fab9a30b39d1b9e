// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/node_selection.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "limber/common/errors.hpp"
#include "unit/flexbody/files.hpp"

namespace limber::flexbody::test::node_selection_test {
namespace {

using ::testing::HasSubstr;

constexpr double kRoundoff = 1e-15;

TEST(NodeSelection, DistanceFromABoxIsThatOfItsNearestPoint) {
  const BoxNodes box{{0, 0, 0}, {1, 2, 3}};
  EXPECT_EQ(calc_distance(box, {0.5, 2, 3}), 0.0);
  EXPECT_NEAR(calc_distance(box, {0.5, 1, 3.5}), 0.5, kRoundoff);
  EXPECT_NEAR(calc_distance(box, {-3, 6, 1}), 5.0, kRoundoff);
}

TEST(NodeSelection, DistanceFromAPlaneIsAlongItsNormalOnEitherSide) {
  const PlaneNodes plane = make_plane({0, 0, 1}, {0, 3, 4}, 0.0);
  EXPECT_NEAR(plane.normal.norm(), 1.0, kRoundoff);
  EXPECT_NEAR(calc_distance(plane, {7, 0, 1}), 0.0, kRoundoff);
  EXPECT_NEAR(calc_distance(plane, {7, 5, 1}), 3.0, 4.0 * kRoundoff);
  EXPECT_NEAR(calc_distance(plane, {7, 0, -4}), 4.0, 4.0 * kRoundoff);
}

TEST(NodeSelection, CylinderIsFilledUnlessItHasAnInnerRadius) {
  const Vector3 from(1, 0, 0);
  const Vector3 to(1, 0, 4);
  const CylinderNodes filled = make_cylinder(from, to, 2.0, 0.0);
  const CylinderNodes tube = make_cylinder(from, to, 2.0, 1.5);
  const Vector3 inside(1.3, 0.4, 2.0);  // 0.5 m from the axis
  EXPECT_EQ(calc_distance(filled, inside), 0.0);
  EXPECT_NEAR(calc_distance(tube, inside), 1.0, 4.0 * kRoundoff);
  for (const CylinderNodes& cylinder : {filled, tube}) {
    const Vector3 in_the_wall(1.0, -1.7, 4.0);  // and in the end's face
    EXPECT_EQ(calc_distance(cylinder, in_the_wall), 0.0);
    EXPECT_NEAR(calc_distance(cylinder, {1, 5, 1}), 3.0, 4.0 * kRoundoff);
    EXPECT_NEAR(calc_distance(cylinder, {1, 1.6, -2}), 2.0, 4.0 * kRoundoff);
    EXPECT_NEAR(calc_distance(cylinder, {1, 5, 8}), 5.0, 4.0 * kRoundoff);
  }
}

TEST(NodeSelection, WhatHasNoDirectionOrNoWallIsRefused) {
  EXPECT_THAT(find_input_error([] {
                (void)make_plane({1, 0, 0}, {0, 0, 0}, 0.0);
              }),
              HasSubstr("normal is zero"));
  EXPECT_THAT(find_input_error([] {
                (void)make_cylinder({1, 2, 3}, {1, 2, 3}, 1.0, 0.0);
              }),
              HasSubstr("(1, 2, 3)"));
  EXPECT_THAT(find_input_error([] {
                (void)make_cylinder({0, 0, 0}, {0, 0, 1}, 0.01, 0.02);
              }),
              HasSubstr("inner radius 0.02 m is above its radius 0.01 m"));
}

std::vector<NodeSelection> list_unequal_selections() {
  const Vector3 p(0.1, 0.2, 0.3);
  const Vector3 q = p + Vector3(0, 0, 1e-15);  // one digit apart
  return {GroupNodes{"tip"},
          GroupNodes{"node:1"},
          GroupNodes{"tip:equal"},
          TaggedNode{1},
          TaggedNode{11},
          NearestNode{p},
          NearestNode{q},
          BoxNodes{p, q},
          BoxNodes{q, p},
          BoxNodes{p, p},
          make_plane(p, {0, 0, 1}, 0.0),
          make_plane(q, {0, 0, 1}, 0.0),
          make_plane(p, {0, 1e-9, 1}, 0.0),
          make_plane(p, {0, 0, 1}, 1e-3),
          make_cylinder(p, {0, 0, 0}, 0.5, 0.0),
          make_cylinder({0, 0, 0}, p, 0.5, 0.0),
          make_cylinder(p, {0, 0, 0}, 0.5, 0.25),
          make_cylinder(p, {0, 0, 0}, std::nextafter(0.5, 1.0), 0.0)};
}

TEST(NodeSelection, UnequalOnesHaveUnequalNames) {
  const std::vector<NodeSelection> all = list_unequal_selections();
  std::set<std::string> names;
  for (const NodeSelection& nodes : all) {
    EXPECT_TRUE(names.insert(name_of(nodes)).second) << name_of(nodes);
  }
  EXPECT_EQ(names.size(), all.size());
}

TEST(NodeSelection, EqualOnesHaveEqualNames) {
  const NodeSelection plane = make_plane({0, 0, 1}, {0, 0, 2}, 0.0);
  const NodeSelection same = make_plane({0, -0.0, 1}, {0, 0, 0.5}, 0.0);
  EXPECT_EQ(plane, same);
  EXPECT_EQ(name_of(plane), name_of(same));
}

TEST(NodeSelection, IsDescribedWithItsNumbers) {
  EXPECT_EQ(describe(make_plane({0, 0, 9}, {0, 0, 2}, 0.25)),
            "the plane through (0, 0, 9) m normal to (0, 0, 1) within 0.25 m");
  EXPECT_EQ(
      describe(make_plane({0, 0, 9}, {0, 0, 2}, 1e-4)),
      "the plane through (0, 0, 9) m normal to (0, 0, 1) within 0.0001 m");
  EXPECT_EQ(describe(make_cylinder({0, 0, 1}, {0, 0, 2}, 0.5, 0.25)),
            "the cylinder from (0, 0, 1) to (0, 0, 2) m of radius 0.5 m "
            "outside 0.25 m");
}

}  // namespace
}  // namespace limber::flexbody::test::node_selection_test
