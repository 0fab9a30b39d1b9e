// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/narrow_phase/shape_pair.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/contact/shapes/skin.hpp"
#include "unit/contact/shapes/surfaces.hpp"

namespace limber::contact::shape_pair_test {
namespace {

using ::testing::HasSubstr;

constexpr double kInf = std::numeric_limits<double>::infinity();

joints::PairBody place(const Vector3& p,
                       const Matrix3& R = Matrix3::Identity()) {
  return {.R_WB = R, .p_WB = p};
}

std::vector<Meeting> meet(const ShapePair& pair, const joints::PairBody& A,
                          const joints::PairBody& B, double reach = 10.0) {
  std::vector<Meeting> out(pair.most_points());
  pair.find({A, B}, reach, out);
  return out;
}

std::shared_ptr<const Skin> make_box_skin() {
  return std::make_shared<const Skin>(
      test::make_box_surface({1, 1, 1}, 2, true));
}

TEST(ShapePair, SpheresOverlapByTheSumOfTheirRadiiLessTheirDistance) {
  const ShapePair pair({Sphere{0.5}, {}}, {Sphere{0.3}, {}});
  const auto at = meet(pair, place({1, 0, 0}), place({1, 0.7, 0}));
  ASSERT_EQ(at.size(), 1u);
  EXPECT_NEAR(at[0].depth, 0.1, 1e-15);
  EXPECT_LT((at[0].normal_W - Vector3(0, 1, 0)).norm(), 1e-15);
  EXPECT_LT((at[0].p_W - Vector3(1, 0.45, 0)).norm(), 1e-15);
  EXPECT_LT((at[0].on_A.x_B - Vector3(0, 0.5, 0)).norm(), 1e-15);
  EXPECT_LT((at[0].on_B.x_B - Vector3(0, -0.3, 0)).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(at[0].curvature, 1.0 / 0.5 + 1.0 / 0.3);
}

TEST(ShapePair, PosesOfShapesOnTheirBodiesCount) {
  const Pose X_BS{exp_rotation(Vector3(0.5 * M_PI, 0, 0)), {0, 0, 1}};
  const ShapePair pair({Capsule{1.0, 1.0}, X_BS}, {Sphere{0.5}, {}});
  const auto at = meet(pair, place({0, 0, 1}), place({0, 2.4, 2}));
  EXPECT_NEAR(at[0].depth, 0.1, 1e-15);
  EXPECT_LT((at[0].normal_W - Vector3(0, 1, 0)).norm(), 1e-15);
  EXPECT_LT((at[0].on_A.x_B - Vector3(0, 2, 1)).norm(), 1e-15);
  EXPECT_LT((at[0].on_B.x_B - Vector3(0, -0.5, 0)).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(at[0].curvature, 3.0);
}

TEST(ShapePair, ASphereInAHollowIsNoFlatterThanFlat) {
  auto hollow = test::make_ball_surface(1.0, 2, true);
  for (auto& f : hollow.faces) f = {f[0], f[2], f[1], f[5], f[4], f[3]};
  const ShapePair pair({Sphere{0.2}, {}},
                       {std::make_shared<const Skin>(hollow), {}});
  const auto free = meet(pair, place({0.85, 0, 0}), place({0, 0, 0}));
  EXPECT_NEAR(free[0].depth, 0.05, 1e-3);
  EXPECT_NEAR(free[0].curvature, 1.0 / 0.2 - 1.0, 0.1);
  const ShapePair large({Sphere{1.5}, {}},
                        {std::make_shared<const Skin>(hollow), {}});
  EXPECT_EQ(meet(large, place({0.2, 0, 0}), place({0, 0, 0}))[0].curvature,
            0.0);
}

TEST(ShapePair, ASphereFarFromASkinIsFoundToBeFar) {
  const ShapePair pair({make_box_skin(), {}}, {Sphere{0.1}, {}});
  EXPECT_EQ(meet(pair, place({0, 0, 0}), place({2, 0, 0}), 0.5)[0].depth,
            -kInf);
  EXPECT_NEAR(meet(pair, place({0, 0, 0}), place({2, 0, 0}), 1.0)[0].depth,
              -0.9, 1e-15);
}

// More than it has room for: the deepest.
TEST(ShapePair, ASkinMeetsAHalfSpaceWithItsDeepestNodes) {
  const auto skin = make_box_skin();
  const ShapePair pair({skin, {}}, {HalfSpace{}, {}});
  ASSERT_GT(skin->node_count(), 64U);
  ASSERT_EQ(pair.most_points(), 64U);
  ASSERT_TRUE(pair.has_loose_features());
  Matrix3 R = exp_rotation(Vector3(0.3, 0.2, 0.0));
  const auto at = meet(pair, place({0, 0, 0.9}, R), place({0, 0, 0}), 1.5);
  std::vector<double> depths;
  for (Eigen::Index i = 0; i < skin->surface().x_B.cols(); ++i) {
    depths.push_back(-0.9 - (R * skin->surface().x_B.col(i)).z());
  }
  std::sort(depths.rbegin(), depths.rend());
  std::vector<double> found;
  for (const Meeting& m : at) {
    EXPECT_EQ(m.normal_W, Vector3(0, 0, -1));
    EXPECT_NEAR(m.depth, -0.9 - (R * m.on_A.x_B).z(), 1e-15);
    found.push_back(m.depth);
  }
  std::sort(found.rbegin(), found.rend());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i], depths[i], 1e-15);
  }
}

TEST(ShapePair, ShapesWithAPotentialAndBadSizesAreRefused) {
  EXPECT_THROW(ShapePair({Box{{1, 1, 1}}, {}}, {HalfSpace{}, {}}), InputError);
  EXPECT_THROW(ShapePair({Box{{1, 1, 1}}, {}}, {Sphere{0.5}, {}}), InputError);
  EXPECT_THROW(ShapePair({Capsule{1, 1}, {}}, {Capsule{1, 1}, {}}), InputError);
  EXPECT_THROW(ShapePair({HalfSpace{}, {}}, {HalfSpace{}, {}}), InputError);
  EXPECT_THROW(ShapePair({Sphere{-1.0}, {}}, {HalfSpace{}, {}}), InputError);
}

}  // namespace
}  // namespace limber::contact::shape_pair_test
