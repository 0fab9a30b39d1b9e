// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/shapes/nearest_point.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "unit/contact/shapes/surfaces.hpp"

namespace limber::contact::nearest_point_test {
namespace {

using Inside = std::function<bool(const Vector3&)>;

constexpr double kPi = std::numbers::pi;

// A shape's surface as points no farther apart than `spacing`, and its inside,
// both without the code under test.
struct Sampled {
  std::function<NearestPoint(const Vector3&)> find;
  std::vector<Vector3> points;
  Inside is_inside;
};

// A solid of revolution about z from its profile (radius, z).
std::vector<Vector3> revolve(
    const std::vector<std::pair<double, double>>& profile) {
  std::vector<Vector3> points;
  for (const auto& at : profile) {
    for (int i = 0; i < 250; ++i) {
      const double angle = 2.0 * kPi * i / 250;
      points.emplace_back(at.first * std::cos(angle),
                          at.first * std::sin(angle), at.second);
    }
  }
  return points;
}

constexpr double kRadius = 0.4;
constexpr double kHalf = 0.7;
constexpr double kSpacing = 0.012;

Sampled sample_sphere() {
  std::vector<std::pair<double, double>> profile;
  for (int i = 0; i <= 120; ++i) {
    profile.emplace_back(kRadius * std::sin(kPi * i / 120),
                         kRadius * std::cos(kPi * i / 120));
  }
  return {[](const Vector3& p) { return find_nearest(Sphere{kRadius}, p); },
          revolve(profile),
          [](const Vector3& p) { return p.norm() < kRadius; }};
}

Sampled sample_capsule() {
  std::vector<std::pair<double, double>> profile;
  for (int i = 0; i <= 60; ++i) {
    const double angle = 0.5 * kPi * i / 60;
    for (const double side : {-1.0, 1.0}) {
      profile.emplace_back(kRadius * std::cos(angle),
                           side * (kHalf + kRadius * std::sin(angle)));
    }
  }
  for (int i = 0; i <= 140; ++i) {
    profile.emplace_back(kRadius, kHalf * (2.0 * i / 140 - 1.0));
  }
  return {[](const Vector3& p) {
            return find_nearest(Capsule{kRadius, kHalf}, p);
          },
          revolve(profile),
          [](const Vector3& p) {
            const double beyond = std::max(std::abs(p.z()) - kHalf, 0.0);
            return std::hypot(p.x(), p.y(), beyond) < kRadius;
          }};
}

void expect_nearest_of_all(const Sampled& shape) {
  std::mt19937 random(1);
  for (int i = 0; i < 60; ++i) {
    const Vector3 p = test::draw_point(random, 1.2);
    const NearestPoint nearest = shape.find(p);
    double least = 1e9;
    for (const Vector3& x : shape.points) {
      least = std::min(least, (x - p).norm());
    }
    const double distance = std::abs(nearest.distance);
    EXPECT_EQ(nearest.distance < 0.0, shape.is_inside(p)) << p.transpose();
    EXPECT_LE(distance, least + 1e-12) << p.transpose();
    EXPECT_GE(distance, least - kSpacing) << p.transpose();
    // The point is that far away along the normal, and on the surface.
    EXPECT_LT((nearest.point + nearest.distance * nearest.normal - p).norm(),
              1e-14);
    EXPECT_LT(std::abs(shape.find(nearest.point).distance), 1e-14);
    EXPECT_TRUE(shape.is_inside((1.0 - 1e-9) * nearest.point));
    EXPECT_FALSE(shape.is_inside((1.0 + 1e-9) * nearest.point));
  }
}

void expect_normal_is_slope(const Sampled& shape) {
  constexpr double kStep = 1e-6;
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    const Vector3 p = test::draw_point(random, 1.2);
    Vector3 slope;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 step = kStep * Vector3::Unit(axis);
      slope[axis] =
          (shape.find(p + step).distance - shape.find(p - step).distance) /
          (2.0 * kStep);
    }
    EXPECT_LT((shape.find(p).normal - slope).norm(), 1e-8) << p.transpose();
  }
}

TEST(NearestPoint, IsTheNearestOfAllOfTheSurfaceAndItsSignTellsTheInside) {
  expect_nearest_of_all(sample_sphere());
  expect_nearest_of_all(sample_capsule());
}

TEST(NearestPoint, NormalIsTheSlopeOfTheDistance) {
  expect_normal_is_slope(sample_sphere());
  expect_normal_is_slope(sample_capsule());
}

TEST(NearestPoint, OfAHalfSpaceIsOnItsPlane) {
  const NearestPoint above = find_nearest(HalfSpace{}, {1.0, 2.0, 3.0});
  EXPECT_EQ(above.distance, 3.0);
  EXPECT_EQ(above.point, Vector3(1.0, 2.0, 0.0));
  EXPECT_EQ(above.normal, Vector3(0.0, 0.0, 1.0));
  EXPECT_EQ(find_nearest(HalfSpace{}, {1.0, 2.0, -3.0}).distance, -3.0);
}

TEST(NearestPoint, MeanCurvatureIsHalfTheSumOfThePrincipalOnes) {
  EXPECT_DOUBLE_EQ(find_nearest(Sphere{0.5}, {1, 1, 1}).curvature, 2.0);
  EXPECT_DOUBLE_EQ(find_nearest(Capsule{0.5, 1.0}, {1, 1, 0.2}).curvature, 1.0);
  EXPECT_DOUBLE_EQ(find_nearest(Capsule{0.5, 1.0}, {0, 1, 2}).curvature, 2.0);
}

TEST(NearestPoint, OfACentreHasAUnitNormal) {
  for (const NearestPoint& at :
       {find_nearest(Sphere{0.5}, Vector3::Zero()),
        find_nearest(Capsule{0.5, 1.0}, Vector3::Zero())}) {
    EXPECT_DOUBLE_EQ(at.normal.norm(), 1.0);
    EXPECT_LT((at.point + at.distance * at.normal).norm(), 1e-15);
  }
}

}  // namespace
}  // namespace limber::contact::nearest_point_test
