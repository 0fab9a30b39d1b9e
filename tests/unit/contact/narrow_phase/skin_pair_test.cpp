// SPDX-License-Identifier: BSD-3-Clause
#include <fcl/fcl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "limber/contact/narrow_phase/shape_pair.hpp"
#include "limber/contact/shapes/shape_skin.hpp"
#include "limber/contact/shapes/skin.hpp"
#include "unit/contact/shapes/surfaces.hpp"

/// Two surfaces against each other.
namespace limber::contact::skin_pair_test {
namespace {

using joints::PairBody;

constexpr double kFar = 1e9;

Shape make_shape(const flexbody::ContactSurface& surface) {
  return {std::make_shared<const Skin>(surface), {}};
}

Shape make_ball(double radius, int subdivisions) {
  return make_shape(test::make_ball_surface(radius, subdivisions, true));
}

PairBody draw_body(std::mt19937& random, const Vector3& p) {
  return {.R_WB = test::draw_rotation(random), .p_WB = p};
}

std::vector<Meeting> meet(const ShapePair& pair, const PairBody& A,
                          const PairBody& B, double reach = 0.0) {
  std::vector<Meeting> all(pair.most_points());
  pair.find({A, B}, reach, all);
  std::erase_if(all, [](const Meeting& m) { return !std::isfinite(m.depth); });
  return all;
}

double find_deepest(const std::vector<Meeting>& all) {
  double depth = -kFar;
  for (const Meeting& m : all) depth = std::max(depth, m.depth);
  return depth;
}

// The faces leave the balls by 1.2e-5 of the radius.
TEST(SkinPair, OfTwoBallsMeetsInOnePlaceWithTheDepthOfTheBalls) {
  constexpr double kMesh = 2e-5;
  const Shape shape_A = make_ball(1.0, 3);
  const Shape shape_B = make_ball(0.5, 3);
  const ShapePair pair(shape_A, shape_B);
  std::mt19937 random(1);
  for (const double depth : {-0.3, -1e-3, 1e-4, 1e-3, 1e-2}) {
    for (int trial = 0; trial < 10; ++trial) {
      const Vector3 way = test::draw_point(random, 1.0).normalized();
      const PairBody A = draw_body(random, {0.1, 0.2, 0.3});
      const PairBody B = draw_body(random, A.p_WB + (1.5 - depth) * way);
      if (depth < 0.0) {
        // By boxes where it is far.
        const double clearance = pair.find_clearance({A, B});
        EXPECT_LT(clearance, -depth + kMesh);
        EXPECT_GT(clearance, depth < -0.1 ? 0.1 : -depth - kMesh);
        EXPECT_TRUE(meet(pair, A, B).empty());
        continue;
      }
      const auto all = meet(pair, A, B);
      ASSERT_FALSE(all.empty()) << depth;
      EXPECT_EQ(pair.find_clearance({A, B}), 0.0);
      double shares = 0.0;
      for (const Meeting& m : all) shares += m.share;
      EXPECT_DOUBLE_EQ(shares, 1.0) << depth;
      EXPECT_NEAR(all[0].depth, depth, kMesh);
      EXPECT_LT((all[0].normal_W - way).norm(), 0.01);
      EXPECT_NEAR(all[0].curvature, 3.0, 0.05);
      EXPECT_LT((all[0].p_W - (A.p_WB + (1.0 - 0.5 * depth) * way)).norm(),
                0.01);
    }
  }
}

// Distances of the same facets by a library that shares no code with ours.
TEST(SkinPair, OfFacetsIsAsFarAsAnotherLibrarySays) {
  using Model = fcl::BVHModel<fcl::OBBRSSd>;
  const auto make_model = [](const flexbody::ContactSurface& surface) {
    std::vector<fcl::Vector3d> points;
    for (const auto& x : surface.x_B.colwise()) points.emplace_back(x);
    std::vector<fcl::Triangle> triangles;
    for (const auto& f : surface.faces) {
      triangles.emplace_back(f[0], f[1], f[2]);
    }
    auto model = std::make_shared<Model>();
    model->beginModel();
    model->addSubModel(points, triangles);
    model->endModel();
    return model;
  };
  const auto surface_A = test::make_box_surface({0.5, 0.4, 0.3}, 3, false);
  const auto surface_B = test::make_ball_surface(0.4, 1, false);
  const auto model_A = make_model(surface_A);
  const auto model_B = make_model(surface_B);
  const ShapePair pair(make_shape(surface_A), make_shape(surface_B));
  std::mt19937 random(2);
  int apart = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const PairBody A = draw_body(random, Vector3::Zero());
    const PairBody B = draw_body(random, test::draw_point(random, 1.2));
    fcl::Transform3d X_A = fcl::Transform3d::Identity();
    X_A.linear() = A.R_WB;
    fcl::Transform3d X_B = fcl::Transform3d::Identity();
    X_B.linear() = B.R_WB;
    X_B.translation() = B.p_WB;
    fcl::DistanceRequestd request(true);
    request.rel_err = 0.0;
    request.abs_err = 0.0;
    fcl::DistanceResultd result;
    fcl::distance(model_A.get(), X_A, model_B.get(), X_B, request, result);
    if (!(result.min_distance > 0.0)) continue;
    ++apart;
    const auto all = meet(pair, A, B, kFar);
    ASSERT_FALSE(all.empty()) << trial;
    EXPECT_NEAR(-find_deepest(all), result.min_distance, 1e-6) << trial;
  }
  EXPECT_GT(apart, 30);
}

TEST(SkinPair, IsAsDeepAsASphereInTheSameSkin) {
  auto surface = test::make_ball_surface(0.8, 2, true);
  test::set_modes(surface, test::make_fields());
  const Shape skin = make_shape(surface);
  const ShapePair meshed(skin, make_ball(0.3, 3));
  const ShapePair exact(skin, {Sphere{0.3}, {}});
  VectorX eta(4);
  eta << 0.05, -0.1, 0.03, 0.1;
  std::mt19937 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    PairBody A = draw_body(random, Vector3::Zero());
    A.modes = 4;
    A.eta = eta.data();
    // Such that the sphere overlaps by 2 mm.
    const Vector3 way = test::draw_point(random, 1.0).normalized();
    PairBody B = draw_body(random, 2.0 * way);
    for (int i = 0; i < 30; ++i) {
      const double depth = find_deepest(meet(exact, A, B, kFar));
      B.p_WB += (depth - 2e-3) * way;
    }
    const auto expected = meet(exact, A, B, kFar);
    const auto found = meet(meshed, A, B, kFar);
    ASSERT_FALSE(found.empty());
    EXPECT_NEAR(find_deepest(found), 2e-3, 1e-5);
    EXPECT_LT((found[0].p_W - expected[0].p_W).norm(), 0.02);
  }
}

TEST(SkinPair, OfFlatFacesMeetsInTheCornersOfTheirCommonArea) {
  const Shape bar = make_shape(test::make_box_surface({1, 0.1, 0.1}, 4, true));
  const ShapePair pair(bar, bar);
  const PairBody A;
  PairBody B{.p_WB = {0.02, 0.03, 0.2 - 1e-5}};
  B.R_WB = Eigen::AngleAxisd(0.5 * M_PI, Vector3::UnitZ()).toRotationMatrix();
  const auto all = meet(pair, A, B);
  // Crossed: a square of the bars' width.
  for (const double x : {-0.08, 0.12}) {
    for (const double y : {-0.1, 0.1}) {
      const auto near = [&](const Meeting& m) {
        return (m.p_W - Vector3(x, y, 0.1)).norm() < 1e-4;
      };
      EXPECT_TRUE(std::any_of(all.begin(), all.end(), near)) << x << " " << y;
    }
  }
  for (const Meeting& m : all) {
    EXPECT_NEAR(m.depth, 1e-5, 1e-12);
    EXPECT_LT((m.normal_W - Vector3::UnitZ()).norm(), 1e-9);
    EXPECT_LT(std::abs(m.p_W.x() - 0.02), 0.1 + 1e-6);
    EXPECT_LT(std::abs(m.p_W.y()), 0.1 + 1e-6);
  }
}

TEST(SkinPair, OfEdgesThatCrossHasTheNormalOfBoth) {
  const Shape box = make_shape(test::make_box_surface({1, 1, 1}, 3, false));
  const ShapePair pair(box, box);
  // Edges along x and y, one above the other.
  const PairBody A{
      .R_WB = Eigen::AngleAxisd(0.25 * M_PI, Vector3::UnitX()).matrix()};
  for (const double depth : {-0.01, 0.01}) {
    const PairBody B{
        .R_WB = Eigen::AngleAxisd(0.25 * M_PI, Vector3::UnitY()).matrix(),
        .p_WB = {0.1, 0.2, 2.0 * std::sqrt(2.0) - depth}};
    const auto all = meet(pair, A, B, kFar);
    ASSERT_FALSE(all.empty());
    EXPECT_NEAR(find_deepest(all), depth, 1e-9);
    EXPECT_LT((all[0].normal_W - Vector3::UnitZ()).norm(), 1e-6);
    EXPECT_LT(
        (all[0].p_W - Vector3(0.1, 0.0, std::sqrt(2.0) - 0.5 * depth)).norm(),
        1e-6);
  }
}

TEST(SkinPair, OfABoxIsThatOfItsMesh) {
  const Shape ball = make_ball(0.3, 2);
  const Pose X{test::draw_rotation(*std::make_unique<std::mt19937>(5)),
               {0.1, 0.0, -0.2}};
  const Vector3 half(0.5, 0.4, 0.3);
  const ShapePair pair(ball, {Box{half}, X});
  std::mt19937 random(6);
  for (int trial = 0; trial < 30; ++trial) {
    const PairBody A = draw_body(random, test::draw_point(random, 0.9));
    const PairBody B = draw_body(random, Vector3::Zero());
    const Vector3 centre = (Pose{B.R_WB, B.p_WB} * X).inverse() * A.p_WB;
    const double depth = 0.3 - test::find_nearest_of_box(half, centre).distance;
    if (depth > 0.05) continue;
    EXPECT_NEAR(find_deepest(meet(pair, A, B, kFar)), depth, 2e-4) << trial;
  }
}

TEST(SkinPair, OfACapsuleLeavesItByLittle) {
  const Capsule capsule{0.2, 0.5};
  const Shape skin = make_skin({capsule, {}});
  const ShapePair pair({Sphere{0.1}, {}}, skin);
  const ShapePair exact({Sphere{0.1}, {}}, {capsule, {}});
  EXPECT_TRUE(std::get<std::shared_ptr<const Skin>>(skin.kind)->is_closed());
  std::mt19937 random(7);
  for (int trial = 0; trial < 100; ++trial) {
    const PairBody A = draw_body(random, test::draw_point(random, 1.0));
    const PairBody B = draw_body(random, Vector3::Zero());
    const double depth = find_deepest(meet(exact, A, B, kFar));
    if (depth > 0.09) continue;
    EXPECT_NEAR(find_deepest(meet(pair, A, B, kFar)), depth, 1e-4 * 0.2);
  }
}

// A large round body's normal hardly changes over a facet: it is between those
// of the facets at a corner, or at an edge, and of none of them.
TEST(SkinPair, OfFacetsOnALargeRoundBodyIsAtTheirCornersAndEdges) {
  const auto surface = test::make_ball_surface(1.0, 2, false);
  const Shape facets = make_shape(surface);
  std::mt19937 random(9);
  for (const double radius : {1.0, 10.0, 100.0}) {
    const double mesh = 3e-5 * radius;
    const ShapePair pair(facets, make_skin({Capsule{radius, radius}, {}}));
    for (int trial = 0; trial < 20; ++trial) {
      const auto& face = surface.faces[random() % surface.faces.size()];
      const Vector3 corner = surface.x_B.col(face[0]);
      const Vector3 place =
          trial % 2 == 0 ? corner
                         : 0.5 * (corner + Vector3(surface.x_B.col(face[1])));
      const Vector3 way = place.normalized();
      Matrix3 R;  // the capsule's axis across
      R.col(2) = way.unitOrthogonal();
      R.col(0) = way;
      R.col(1) = R.col(2).cross(way);
      for (const double depth : {-0.02, 0.02}) {
        const PairBody A;
        const PairBody B{.R_WB = R, .p_WB = place + (radius - depth) * way};
        const auto all = meet(pair, A, B, kFar);
        ASSERT_FALSE(all.empty()) << radius << ' ' << trial;
        EXPECT_NEAR(find_deepest(all), depth, mesh) << radius << ' ' << trial;
        EXPECT_LT((all[0].normal_W - way).norm(), 0.01);
      }
    }
  }
}

TEST(SkinPair, OfAPlateIsNotThatOfItsFarSide) {
  const Shape plate =
      make_shape(test::make_box_surface({1, 1, 0.001}, 8, false));
  const ShapePair pair(make_ball(0.3, 3), plate);
  const PairBody B;
  for (const double depth : {-1e-3, 1e-4, 9e-4}) {
    const PairBody A{.p_WB = {0.03, 0.02, 0.301 - depth}};
    EXPECT_NEAR(find_deepest(meet(pair, A, B, kFar)), depth, 2e-5);
  }
}

TEST(SkinPair, OfSoftBodiesIsFoundDeepAsWell) {
  const ShapePair pair(make_ball(1.0, 3), make_ball(1.0, 3));
  std::mt19937 random(8);
  for (const double depth : {0.03, 0.1}) {
    for (int trial = 0; trial < 5; ++trial) {
      const PairBody A = draw_body(random, Vector3::Zero());
      const PairBody B = draw_body(
          random, (2.0 - depth) * test::draw_point(random, 1).normalized());
      EXPECT_NEAR(find_deepest(meet(pair, A, B)), depth, 2e-3 * depth) << depth;
    }
  }
}

}  // namespace
}  // namespace limber::contact::skin_pair_test
