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
  const Pose X_BS{exp_rotation(Vector3(0, 0, 0.5 * M_PI)), {0, 0, 1}};
  const ShapePair pair({Box{{2, 1, 1}}, X_BS}, {Sphere{0.5}, {}});
  const auto at = meet(pair, place({0, 0, 1}), place({0, 2.4, 2}));
  EXPECT_NEAR(at[0].depth, 0.1, 1e-15);
  EXPECT_LT((at[0].normal_W - Vector3(0, 1, 0)).norm(), 1e-15);
  EXPECT_LT((at[0].on_A.x_B - Vector3(0, 2, 1)).norm(), 1e-15);
  EXPECT_LT((at[0].on_B.x_B - Vector3(0, -0.5, 0)).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(at[0].curvature, 2.0);
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

TEST(ShapePair, ABoxMeetsAHalfSpaceWithEachCorner) {
  const ShapePair pair({HalfSpace{}, {}}, {Box{{1, 2, 3}}, {}});
  const auto at = meet(pair, place({0, 0, 0.1}), place({0, 0, 3}));
  ASSERT_EQ(at.size(), 8u);
  int below = 0;
  for (const Meeting& corner : at) {
    const Vector3& x = corner.on_B.x_B;
    EXPECT_EQ(x.cwiseAbs(), Vector3(1, 2, 3));
    EXPECT_NEAR(corner.depth, 0.1 - (3.0 + x.z()), 1e-14);
    EXPECT_EQ(corner.normal_W, Vector3(0, 0, 1));
    below += corner.depth > 0.0 ? 1 : 0;
  }
  EXPECT_EQ(below, 4);
}

// Its height and tilt alone give the net force, whichever way it tilts.
TEST(ShapePair, AStandingCylinderIsHeldTheSameWhicheverWayItTilts) {
  const ShapePair pair({HalfSpace{}, {}}, {Cylinder{0.5, 1.0}, {}});
  const auto find_load = [&pair](const Vector3& tilt) {
    const Matrix3 R = exp_rotation(tilt);
    Vector6 load = Vector6::Zero();  // moment, force at Bo; unit stiffness
    for (const Meeting& m :
         meet(pair, place({0, 0, 0}), place({0, 0, 0.9}, R))) {
      if (!(m.depth > 0.0)) continue;
      const Vector3 force = m.depth * m.normal_W;
      load.head<3>() += (R * m.on_B.x_B).cross(force);
      load.tail<3>() += force;
    }
    return load;
  };
  EXPECT_NEAR(find_load(Vector3::Zero())[5], 0.3, 1e-14);
  EXPECT_LT(find_load(Vector3::Zero()).head<3>().norm(), 1e-14);
  constexpr double kTilt = 1e-3;
  const Vector6 first = find_load({kTilt, 0, 0});
  // Three points of unit stiffness push back by 3/2 radius^2, the weight on
  // them by its lever the other way.
  EXPECT_NEAR(first[0], -(1.5 * 0.25 - 0.3) * kTilt, 1e-3 * kTilt);
  for (double angle = 0.1; angle < 6.0; angle += 0.3) {
    const Matrix3 turn = exp_rotation(Vector3(0, 0, angle));
    const Vector6 load = find_load(turn * Vector3(kTilt, 0, 0));
    EXPECT_LT((load.head<3>() - turn * first.head<3>()).norm(), 1e-15);
    EXPECT_NEAR(load[5], first[5], 1e-15);
  }
}

TEST(ShapePair, ALyingCylinderTouchesWithTheLowestPointOfEachRim) {
  const ShapePair pair({HalfSpace{}, {}}, {Cylinder{0.5, 1.0}, {}});
  std::vector<double> depths;
  const Matrix3 R = exp_rotation(Vector3(0.5 * M_PI, 0, 0));
  for (const Meeting& m :
       meet(pair, place({0, 0, 0}), place({0, 0, 0.45}, R))) {
    depths.push_back(m.depth);
  }
  std::sort(depths.rbegin(), depths.rend());
  EXPECT_NEAR(depths[0], 0.05, 1e-15);
  EXPECT_NEAR(depths[1], 0.05, 1e-15);
  EXPECT_LT(depths[2], -0.6);
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

TEST(ShapePair, CapsulesThatCrossMeetWhereTheirAxesAreNearest) {
  const Pose turned{exp_rotation(Vector3(0.5 * M_PI, 0, 0)), Vector3::Zero()};
  const ShapePair pair({Capsule{0.2, 1.0}, {}}, {Capsule{0.3, 1.0}, turned});
  const auto at = meet(pair, place({0, 0, 0}), place({0.4, 0.5, 0.25}));
  EXPECT_NEAR(at[0].depth, 0.1, 1e-15);
  EXPECT_LT((at[0].normal_W - Vector3(1, 0, 0)).norm(), 1e-15);
  EXPECT_LT((at[0].on_A.x_B - Vector3(0.2, 0, 0.25)).norm(), 1e-15);
  EXPECT_LT((at[0].on_B.x_B - Vector3(-0.3, -0.5, 0)).norm(), 1e-15);
  EXPECT_LT((at[0].p_W - Vector3(0.15, 0, 0.25)).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(at[0].curvature, 0.5 / 0.2 + 0.5 / 0.3);
}

TEST(ShapePair, CapsulesWhoseAxesTouchHaveANormalToBoth) {
  const ShapePair pair({Capsule{0.2, 1.0}, {}}, {Capsule{0.3, 1.0}, {}});
  for (const double angle : {0.0, 1e-6, 1.0}) {
    const auto at = meet(pair, place({0, 0, 0}),
                         place({0, 0, 0}, exp_rotation(Vector3(0, angle, 0))));
    EXPECT_NEAR(at[0].depth, 0.5, 1e-15);
    EXPECT_NEAR(at[0].normal_W.norm(), 1.0, 1e-15);
    EXPECT_NEAR(at[0].normal_W.z(), 0.0, 1e-15);
  }
}

TEST(ShapePair, TwoHalfSpacesAndBadSizesAreRefused) {
  EXPECT_THROW(ShapePair({HalfSpace{}, {}}, {HalfSpace{}, {}}), InputError);
  EXPECT_THROW(ShapePair({Sphere{-1.0}, {}}, {HalfSpace{}, {}}), InputError);
}

}  // namespace
}  // namespace limber::contact::shape_pair_test
