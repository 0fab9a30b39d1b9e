// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/modal/interfaces.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limber/common/errors.hpp"
#include "limber/fem/mesh/mesh_reader.hpp"
#include "places.hpp"

/// Node selections on the beam of 1 x 1 x 5 m: root at z = 0, tip at z = 5.
namespace limber::flexbody::interfaces_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const fem::Mesh& beam() {
  static const fem::Mesh mesh =
      fem::read_mesh(LIMBER_SOURCE_DIR "/tests/data/beam/beam579_v41.msh");
  return mesh;
}

Interface find(const NodeSelection& nodes,
               Weighting weighting = Weighting::uniform) {
  Recipe recipe;
  recipe.interfaces = {{"seat", nodes, weighting}};
  return find_interfaces(beam(), recipe).front();
}

std::string error_of(const Recipe& recipe) {
  try {
    (void)find_interfaces(beam(), recipe);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string error_of(const NodeSelection& nodes) {
  Recipe recipe;
  recipe.interfaces = {{"seat", nodes}};
  return error_of(recipe);
}

void expect_same(const Interface& a, const Interface& b) {
  EXPECT_EQ(a.selection.nodes, b.selection.nodes);
  ASSERT_EQ(a.selection.weights.size(), b.selection.weights.size());
  EXPECT_LT((a.selection.weights - b.selection.weights).norm(), 1e-12);
}

TEST(Interfaces, PlaneOfAFaceIsTheFacesGroup) {
  const Interface tip = find(GroupNodes{"tip"});
  EXPECT_GT(tip.selection.nodes.size(), 30U);
  expect_same(find(make_plane({7, 7, 5}, {0, 0, -3}, 0.0)), tip);
  expect_same(find(make_plane({0, 0, 5.04}, {0, 0, 1}, 0.05)), tip);
}

TEST(Interfaces, CylinderHoldsTheSurfaceNodesInItsBounds) {
  const CylinderNodes around =
      make_cylinder({0.5, 0.5, 5.0}, {0.5, 0.5, 6.0}, 0.55, 0.45);
  std::vector<int> expected;
  for (const int n : beam().boundary_nodes) {
    const Vector3 x = beam().x.col(n);
    const double r = std::hypot(x.x() - 0.5, x.y() - 0.5);
    if (x.z() > 4.99 && r > 0.45 && r < 0.55) expected.push_back(n);
  }
  ASSERT_GT(expected.size(), 3U);
  EXPECT_EQ(find(around, Weighting::equal).selection.nodes, expected);
}

TEST(Interfaces, CylinderAroundTheWholeFaceIsItsGroup) {
  expect_same(
      find(make_cylinder({0.5, 0.5, 4.99}, {0.5, 0.5, 5}, std::sqrt(0.5), 0.0)),
      find(GroupNodes{"tip"}));
}

TEST(Interfaces, WithoutNodesAreReportedWithTheSelectionAndTheNearestNode) {
  EXPECT_THAT(error_of(BoxNodes{{0, 0, 7}, {1, 1, 8}}),
              AllOf(StartsWith("interface 'seat': "),
                    HasSubstr("beam579_v41.msh: no surface node belongs to the "
                              "box from (0, 0, 7) to (1, 1, 8) m; the nearest "
                              "is 2 m away")));
  EXPECT_THAT(error_of(make_plane({0, 0, -0.5}, {0, 0, 1}, 0.25)),
              AllOf(StartsWith("interface 'seat': "),
                    HasSubstr("the plane through (0, 0, -0.5) m normal to (0, "
                              "0, 1) within 0.25 m; the nearest is 0.5 m "
                              "away")));
  EXPECT_THAT(
      error_of(make_cylinder({0.5, 0.5, 8}, {0.5, 0.5, 9}, 2.0, 0.0)),
      AllOf(StartsWith("interface 'seat': "),
            HasSubstr("the cylinder from (0.5, 0.5, 8) to (0.5, 0.5, 9) m of "
                      "radius 2 m; the nearest is 3 m away")));
  EXPECT_THAT(error_of(GroupNodes{"tipp"}),
              AllOf(StartsWith("interface 'seat': "), HasSubstr("'tipp'"),
                    HasSubstr("did you mean 'tip'")));
  EXPECT_THAT(error_of(TaggedNode{123456}),
              AllOf(StartsWith("interface 'seat': "), HasSubstr("123456")));
}

TEST(Interfaces, NearestNodeIsNeverEmpty) {
  const Interface far = find(NearestNode{{9, 9, 99}});
  ASSERT_EQ(far.selection.nodes.size(), 1U);
  EXPECT_LT((beam().x.col(far.selection.nodes[0]) - Vector3(1, 1, 5)).norm(),
            1e-12);
}

TEST(Interfaces, ThatAreEmptyAreAllReportedAtOnce) {
  Recipe recipe;
  recipe.interfaces = {{"first", GroupNodes{"none"}},
                       {"tip", GroupNodes{"tip"}},
                       {"second", TaggedNode{123456}}};
  EXPECT_THAT(error_of(recipe), AllOf(HasSubstr("interface 'first'"),
                                      HasSubstr("interface 'second'")));
}

}  // namespace
}  // namespace limber::flexbody::interfaces_test
