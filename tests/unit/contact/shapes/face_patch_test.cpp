// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/shapes/face_patch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "unit/contact/shapes/surfaces.hpp"

namespace limber::contact::face_patch_test {
namespace {

constexpr std::array<FacePlace, 6> kNodes = {
    {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.5, 0.0}, {0.5, 0.5}, {0.0, 0.5}}};

// z = 1/2 (a x^2 + b y^2) over a triangle of the plane, which a quadratic face
// is exactly.
FacePatch make_paraboloid(double a, double b) {
  std::array<Vector3, 6> X;
  for (std::size_t i = 0; i < 6; ++i) {
    const double x = -0.4 + 1.3 * kNodes[i].u + 0.2 * kNodes[i].v;
    const double y = -0.5 + 0.1 * kNodes[i].u + 1.1 * kNodes[i].v;
    X[i] = {x, y, 0.5 * (a * x * x + b * y * y)};
  }
  return FacePatch(X);
}

// A flat face whose nodes are off by up to `noise`.
FacePatch make_noisy(std::mt19937& random, double noise) {
  std::array<Vector3, 6> X;
  for (std::size_t i = 0; i < 6; ++i) {
    X[i] = Vector3(kNodes[i].u, kNodes[i].v, 0.0) +
           test::draw_point(random, noise);
  }
  return FacePatch(X);
}

template <class Use>
void visit_grid(int cells, const Use& use) {
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; i + j <= cells; ++j) {
      use(FacePlace{static_cast<double>(i) / cells,
                    static_cast<double>(j) / cells});
    }
  }
}

TEST(FacePatch, GoesThroughItsNodesWithTheShapeFunctionsOfTheTriangle) {
  std::mt19937 random(1);
  std::array<Vector3, 6> X;
  for (Vector3& x : X) x = test::draw_point(random, 1.0);
  const FacePatch patch(X);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_LT((patch.find_point(kNodes[i]) - X[i]).norm(), 1e-14);
  }
  visit_grid(5, [&](const FacePlace& at) {
    const auto weights = find_shape_functions(at, false);
    Vector3 sum = Vector3::Zero();
    for (std::size_t i = 0; i < 6; ++i) sum += weights[i] * X[i];
    EXPECT_LT((patch.find_point(at) - sum).norm(), 1e-14);
    const double step = 1e-6;
    const Vector3 slope = (patch.find_point({at.u + step, at.v}) -
                           patch.find_point({at.u - step, at.v})) /
                          (2.0 * step);
    EXPECT_LT((patch.find_tangent_u(at) - slope).norm(), 1e-8);
  });
}

// Of a graph z(x, y): half of div(grad z / sqrt(1 + |grad z|^2)), convex where
// it bends away from the normal, which is along +z here.
TEST(FacePatch, MeanCurvatureOfAParaboloidIsThatOfItsFormula) {
  const double a = -0.7;
  const double b = -1.9;
  const FacePatch patch = make_paraboloid(a, b);
  visit_grid(6, [&](const FacePlace& at) {
    const Vector3 p = patch.find_point(at);
    const double zx = a * p.x();
    const double zy = b * p.y();
    const double w = 1.0 + zx * zx + zy * zy;
    const double mean =
        0.5 * ((1.0 + zy * zy) * a + (1.0 + zx * zx) * b) / (w * std::sqrt(w));
    EXPECT_NEAR(patch.find_mean_curvature(at), -mean, 1e-13);
  });
}

TEST(FacePatch, IsNowhereFartherFromItsFlatPartsThanTheBulge) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 20; ++trial) {
    const FacePatch patch = make_noisy(random, 0.2);
    double largest = 0.0;
    visit_grid(20, [&](const FacePlace& at) {
      const double square =
          patch.find_nearest_of_flat(patch.find_point(at)).square;
      largest = std::max(largest, std::sqrt(square));
    });
    EXPECT_LE(largest, patch.find_bulge() + 1e-14);
    EXPECT_GT(largest, 0.2 * patch.find_bulge());  // it is no empty promise
  }
}

TEST(FacePatch, NearestPointIsThatOfADenseGrid) {
  constexpr int kCells = 200;
  std::mt19937 random(3);
  for (int trial = 0; trial < 30; ++trial) {
    const FacePatch patch = make_noisy(random, 0.05);
    const Vector3 p = test::draw_point(random, 0.8) + Vector3(0.3, 0.3, 0.0);
    const FacePlace at =
        patch.find_nearest(p, patch.find_nearest_of_flat(p).at);
    const double found = (patch.find_point(at) - p).norm();
    double least = 1e9;
    visit_grid(kCells, [&](const FacePlace& place) {
      least = std::min(least, (patch.find_point(place) - p).norm());
    });
    EXPECT_GE(at.u, 0.0);
    EXPECT_GE(at.v, 0.0);
    EXPECT_LE(at.u + at.v, 1.0 + 1e-15);
    EXPECT_LE(found, least + 1e-12);
    EXPECT_GE(found, least - 2.0 / kCells);
  }
}

// A point above a place, along the normal there, has that place as its nearest.
TEST(FacePatch, NearestPointInsideIsFoundToRoundOff) {
  const FacePatch patch = make_paraboloid(-0.7, -1.9);
  visit_grid(7, [&](const FacePlace& at) {
    if (std::min({at.u, at.v, 1.0 - at.u - at.v}) < 0.01) return;
    const Vector3 x = patch.find_point(at);
    const Vector3 normal = patch.find_normal(at).normalized();
    for (const double distance : {-0.1, -1e-6, 0.0, 1e-6, 0.3, 5.0}) {
      const Vector3 p = x + distance * normal;
      const FacePlace found =
          patch.find_nearest(p, patch.find_nearest_of_flat(p).at);
      EXPECT_NEAR(found.u, at.u, 1e-13) << distance;
      EXPECT_NEAR(found.v, at.v, 1e-13) << distance;
    }
  });
}

TEST(FacePatch, StraightFacesHaveNoCurvatureAndTheirOwnNearestPoint) {
  const FacePatch patch(
      std::array<Vector3, 3>{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  EXPECT_EQ(patch.find_mean_curvature({0.2, 0.3}), 0.0);
  EXPECT_EQ(patch.find_bulge(), 0.0);
  const auto above = patch.find_nearest_of_flat({0.25, 0.5, 2.0});
  EXPECT_DOUBLE_EQ(above.at.u, 0.25);
  EXPECT_DOUBLE_EQ(above.at.v, 0.5);
  EXPECT_DOUBLE_EQ(above.square, 4.0);
  const auto beyond = patch.find_nearest_of_flat({1.0, 1.0, 0.0});
  EXPECT_DOUBLE_EQ(beyond.at.u, 0.5);
  EXPECT_DOUBLE_EQ(beyond.at.v, 0.5);
}

}  // namespace
}  // namespace limber::contact::face_patch_test
