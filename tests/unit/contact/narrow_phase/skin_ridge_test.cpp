// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "limber/common/rotation.hpp"
#include "limber/contact/narrow_phase/shape_pair.hpp"
#include "limber/contact/shapes/skin.hpp"
#include "unit/contact/shapes/surfaces.hpp"

/// An edge of a box that is pressed along a flat sheet: both ends of the line.
namespace limber::contact::skin_ridge_test {
namespace {

using joints::PairBody;

constexpr double kHalf = 5e-3;  // of the sheet [m]
constexpr double kBoxHalf = 0.05;

/// Where the edge is: through `p`, along `way`, with the box's lower face at
/// `tilt` to the sheet.
struct Edge {
  double tilt = 0.0;   // [rad]
  double turn = 0.0;   // about the sheet's normal [rad]
  double slope = 0.0;  // along the edge, upwards [rad]
  Vector3 p = Vector3::Zero();

  [[nodiscard]] Matrix3 rotation() const {
    return exp_rotation(turn * Vector3::UnitZ()) *
           exp_rotation(slope * Vector3::UnitX()) *
           exp_rotation(tilt * Vector3::UnitY());
  }
  [[nodiscard]] Vector3 way() const { return rotation().col(1); }
  [[nodiscard]] PairBody body() const {
    const Vector3 edge(kBoxHalf, 0.0, -kBoxHalf);
    return {.R_WB = rotation(), .p_WB = p - rotation() * edge};
  }
};

Edge draw_edge(std::mt19937& random, double depth) {
  const auto between = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  Edge edge;
  edge.tilt = std::pow(10.0, between(-1.9, -0.05));
  edge.turn = between(-3.0, 3.0);
  edge.slope = between(-1.0, 1.0) * 0.1 * depth / kHalf;
  edge.p = {between(-0.5, 0.5) * kHalf, between(-0.5, 0.5) * kHalf, -depth};
  return edge;
}

// Where it leaves the sheet, seen from above.
std::vector<Vector3> find_ends(const Edge& edge) {
  std::vector<Vector3> ends;
  const Vector3 way = edge.way();
  for (int axis = 0; axis < 2; ++axis) {
    for (const double side : {-kHalf, kHalf}) {
      const double t = (side - edge.p[axis]) / way[axis];
      const Vector3 x = edge.p + t * way;
      if (std::abs(x[1 - axis]) < kHalf) ends.push_back(x);
    }
  }
  return ends;
}

class EdgeOnSheet : public ::testing::TestWithParam<int> {
 protected:
  EdgeOnSheet()
      : pair_(
            {std::make_shared<const Skin>(test::make_sheet_surface(
                 kHalf, GetParam(), false, [](double, double) { return 0.0; })),
             {}},
            {Box{Vector3::Constant(kBoxHalf)}, {}}) {}

  [[nodiscard]] std::vector<Meeting> meet(const PairBody& box) const {
    std::vector<Meeting> all(pair_.most_points());
    pair_.find({PairBody{}, box}, 0.0, all);
    std::erase_if(all, [](const Meeting& m) { return !(m.depth > 0.0); });
    return all;
  }

  ShapePair pair_;
};

TEST_P(EdgeOnSheet, MeetsAtBothEndsOfTheLine) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const double depth = 1e-5;
    const Edge edge = draw_edge(random, depth);
    const auto ends = find_ends(edge);
    ASSERT_EQ(ends.size(), 2U);
    const auto found = meet(edge.body());
    ASSERT_GE(found.size(), 2U);
    for (const Meeting& meeting : found) {
      const bool is_end =
          std::any_of(ends.begin(), ends.end(), [&](const Vector3& end) {
            return (meeting.p_W - end).norm() < 2.0 * depth;
          });
      const Vector3 from_corner =
          meeting.p_W.cwiseAbs() - Vector3(kHalf, kHalf, 0.0);
      EXPECT_TRUE(is_end || from_corner.norm() < 2.0 * depth);
    }
    for (const Vector3& end : ends) {
      const auto nearest = std::min_element(
          found.begin(), found.end(), [&](const Meeting& a, const Meeting& b) {
            return (a.p_W - end).norm() < (b.p_W - end).norm();
          });
      EXPECT_LT((nearest->p_W - end).norm(), 2.0 * depth);
      EXPECT_NEAR(nearest->depth, -end.z(), 1e-3 * depth);
      EXPECT_NEAR(nearest->share, 1.0, 1e-12);
    }
  }
}

// Of forces that follow from an energy, d depth = -normal . (d p of the box).
TEST_P(EdgeOnSheet, HasNormalsThatAreTheDepthsGradients) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const PairBody box = draw_edge(random, 1e-5).body();
    const Vector3 shift = 1e-8 * test::draw_point(random, 1.0);
    const Vector3 turn = 1e-7 * test::draw_point(random, 1.0);
    const Matrix3 R = exp_rotation(turn);
    PairBody moved = box;
    moved.R_WB = R * box.R_WB;
    moved.p_WB = R * box.p_WB + shift;
    const auto before = meet(box);
    for (const Meeting& after : meet(moved)) {
      const auto same = std::min_element(
          before.begin(), before.end(),
          [&](const Meeting& a, const Meeting& b) {
            return (a.p_W - after.p_W).norm() < (b.p_W - after.p_W).norm();
          });
      const Vector3 motion = turn.cross(same->p_W) + shift;
      EXPECT_NEAR(after.depth - same->depth, -same->normal_W.dot(motion),
                  1e-3 * motion.norm());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cells, EdgeOnSheet, ::testing::Values(1, 2, 3, 5));

}  // namespace
}  // namespace limber::contact::skin_ridge_test
