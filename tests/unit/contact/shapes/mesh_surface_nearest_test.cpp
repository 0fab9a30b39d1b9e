// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "limber/contact/shapes/mesh_surface.hpp"
#include "unit/contact/shapes/surfaces.hpp"

namespace limber::contact::surface_nearest_test {
namespace {

using test::view;

constexpr double kFar = 100.0;
const VectorX kStill = VectorX::Zero(0);

VectorX draw_eta(std::mt19937& random, double scale) {
  return scale * VectorX::NullaryExpr(4, [&random] {
           return std::uniform_real_distribution<double>(-1.0, 1.0)(random);
         });
}

MeshSurface make_flexible_ball(int subdivisions, bool quadratic) {
  auto surface = test::make_ball_surface(0.8, subdivisions, quadratic);
  test::set_modes(surface, test::make_fields());
  return MeshSurface(surface);
}

// Of the deformed faces, by a grid of each.
double find_least_distance(const MeshSurface& mesh_surface, const VectorX& eta,
                           const Vector3& p, int cells) {
  double least = 1e9;
  for (std::size_t f = 0; f < mesh_surface.surface().faces.size(); ++f) {
    for (int i = 0; i <= cells; ++i) {
      for (int j = 0; i + j <= cells; ++j) {
        const SurfacePlace place{.face = static_cast<int>(f),
                                 .u = static_cast<double>(i) / cells,
                                 .v = static_cast<double>(j) / cells};
        least = std::min(
            least, (mesh_surface.find_position(place, view(eta)) - p).norm());
      }
    }
  }
  return least;
}

TEST(SurfaceNearest, IsTheNearestOfAllDeformedFaces) {
  std::mt19937 random(1);
  for (const bool quadratic : {false, true}) {
    const MeshSurface mesh_surface = make_flexible_ball(1, quadratic);
    for (int i = 0; i < 20; ++i) {
      const VectorX eta = draw_eta(random, 0.2);
      const Vector3 p = test::draw_point(random, 1.2);
      const auto hit = mesh_surface.find_nearest(p, view(eta), kFar, kFar);
      ASSERT_TRUE(hit.has_value());
      const double least = find_least_distance(mesh_surface, eta, p, 24);
      EXPECT_LE(std::abs(hit->nearest.distance), least + 1e-12);
      EXPECT_GE(std::abs(hit->nearest.distance), least - 0.02);
      EXPECT_LT(
          (hit->nearest.point + hit->nearest.distance * hit->nearest.normal - p)
              .norm(),
          1e-12);
      EXPECT_LT((mesh_surface.find_position(hit->place, view(eta)) -
                 hit->nearest.point)
                    .norm(),
                1e-14);
    }
  }
}

// Distances of a box are known in closed form, and most points near one are
// nearest to its edges and corners.
TEST(SurfaceNearest, OfABoxIsThatOfTheClosedFormInsideAndOutside) {
  const Vector3 half(0.3, 0.5, 0.4);
  std::mt19937 random(2);
  for (const bool quadratic : {false, true}) {
    auto surface = test::make_box_surface(half, 3, quadratic);
    test::set_modes(surface,
                    {[](const Vector3& x) { return Vector3(x.x(), 0, 0); },
                     [](const Vector3& x) { return Vector3(0, 0, x.z()); }});
    const MeshSurface mesh_surface(surface);
    EXPECT_TRUE(mesh_surface.is_closed());
    for (int i = 0; i < 300; ++i) {
      const VectorX eta = draw_eta(random, 0.3).head(2);
      const Vector3 box =
          half.cwiseProduct(Vector3(1.0 + eta[0], 1.0, 1.0 + eta[1]));
      const Vector3 p = test::draw_point(random, 0.8);
      const MeshSurface::NearestPoint expected =
          test::find_nearest_of_box(box, p);
      const auto hit = mesh_surface.find_nearest(p, view(eta), kFar, 0.0);
      ASSERT_TRUE(hit.has_value());
      EXPECT_NEAR(hit->nearest.distance, expected.distance, 1e-13);
      EXPECT_LT((hit->nearest.normal - expected.normal).norm(), 1e-9);
      EXPECT_NEAR(mesh_surface.find_clearance(p, 0.1, view(eta)),
                  expected.distance - 0.1, 1e-13);
    }
  }
}

// Straight above corners, edges and their ends in every direction between the
// normals of the faces.
TEST(SurfaceNearest, ExactlyOverCornersAndEdgesOfABoxIsOutside) {
  const MeshSurface mesh_surface(test::make_box_surface({1, 1, 1}, 2, true));
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    Vector3 away = test::draw_point(random, 1.0).cwiseAbs();
    Vector3 x(1.0, 1.0, 0.5 * (i % 3));  // an edge, and its ends
    if (i % 3 < 2) away.z() = 0.0;
    const double distance = 0.01 + 0.1 * (i % 7);
    const auto hit = mesh_surface.find_nearest(x + distance * away.normalized(),
                                               view(kStill), kFar, 0.0);
    ASSERT_TRUE(hit.has_value());
    EXPECT_NEAR(hit->nearest.distance, distance, 1e-13);
    EXPECT_LT((hit->nearest.normal - away.normalized()).norm(), 1e-10);
  }
}

// A box sheared to sharp edges and corners, where a point outside is behind
// some of the faces that it is nearest to. What is inside the box follows from
// undoing the shear.
TEST(SurfaceNearest, SignOverSharpEdgesAndCornersIsThatOfAllTheirFaces) {
  const Vector3 half(0.3, 0.3, 0.3);
  auto surface = test::make_box_surface(half, 2, true);
  test::set_modes(surface,
                  {[](const Vector3& x) { return Vector3(x.z(), 0, 0); },
                   [](const Vector3& x) { return Vector3(0, x.z(), 0); }});
  const MeshSurface mesh_surface(surface);
  std::mt19937 random(8);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const VectorX eta = Eigen::Vector2d(3.0, i % 2 == 0 ? 2.0 : -1.0);
    const Vector3 p = test::draw_point(random, 1.5);
    const Vector3 x = p - p.z() * Vector3(eta[0], eta[1], 0.0);
    const bool is_inside = (x.cwiseAbs().array() < half.array()).all();
    const auto hit = mesh_surface.find_nearest(p, view(eta), kFar, 0.0);
    ASSERT_TRUE(hit.has_value());
    EXPECT_EQ(hit->nearest.distance < 0.0, is_inside) << p.transpose();
    inside += is_inside ? 1 : 0;
  }
  EXPECT_GT(inside, 10);
}

// The distance from any surface changes by at most the way of the point.
TEST(SurfaceNearest, DistanceAndNormalHaveNoJumpAlongPathsOverBordersOfFaces) {
  constexpr double kStep = 1e-3;
  std::mt19937 random(4);
  const MeshSurface mesh_surface = make_flexible_ball(1, true);
  for (int path = 0; path < 4; ++path) {
    const VectorX eta = draw_eta(random, 0.05);
    const Matrix3 R = test::draw_rotation(random);
    double last = 0.0;
    Vector3 last_normal = Vector3::Zero();
    int faces = 0;
    int last_face = -1;
    for (int i = 0; i < 3000; ++i) {
      const double angle = i * kStep;
      const Vector3 p = R * Vector3(std::cos(angle), std::sin(angle), 0.0);
      const auto hit = mesh_surface.find_nearest(p, view(eta), 1.0, 0.0);
      ASSERT_TRUE(hit.has_value());
      if (i > 0) {
        EXPECT_LE(std::abs(hit->nearest.distance - last), kStep);
        // Where its foot stays on an edge, the normal turns by the way of the
        // point over its distance; on a face that is convex, by less.
        EXPECT_LE((hit->nearest.normal - last_normal).norm(),
                  1.1 * kStep / last);
        faces += hit->place.face == last_face ? 0 : 1;
      }
      last = hit->nearest.distance;
      last_normal = hit->nearest.normal;
      last_face = hit->place.face;
    }
    EXPECT_GT(faces, 5);  // it did go over borders
  }
}

TEST(SurfaceNearest, QuadraticFacesOfABallHaveItsRadiusAndCurvature) {
  constexpr double kRadius = 0.8;
  std::mt19937 random(5);
  double last_error = 1.0;
  double last_bend_error = 1.0;
  for (int subdivisions = 1; subdivisions <= 3; ++subdivisions) {
    const MeshSurface mesh_surface(
        test::make_ball_surface(kRadius, subdivisions, true));
    double error = 0.0;
    double bend_error = 0.0;
    for (int i = 0; i < 100; ++i) {
      const Vector3 p = 1.1 * test::draw_point(random, 1.0).normalized();
      const auto hit = mesh_surface.find_nearest(p, view(kStill), 1.0, 0.0);
      ASSERT_TRUE(hit.has_value());
      error = std::max(error, std::abs(hit->nearest.distance - 0.3));
      bend_error = std::max(bend_error,
                            std::abs(hit->nearest.curvature * kRadius - 1.0));
    }
    // Positions converge with the third power of the size at least, second
    // derivatives with the first.
    EXPECT_LT(error, last_error / 8.0 * 1.3);
    EXPECT_LT(bend_error, last_bend_error / 2.0 * 1.3);
    last_error = error;
    last_bend_error = bend_error;
  }
  EXPECT_LT(last_error, 1e-4 * kRadius);
  EXPECT_LT(last_bend_error, 0.05);
}

TEST(SurfaceNearest, DistanceChangesAsTheModesMoveThePlace) {
  constexpr double kStep = 1e-6;
  std::mt19937 random(6);
  const MeshSurface mesh_surface = make_flexible_ball(1, true);
  Matrix3X Phi(3, 4);
  for (int i = 0; i < 20; ++i) {
    const VectorX eta = draw_eta(random, 0.1);
    const Vector3 p = test::draw_point(random, 1.0).normalized();
    const auto hit = mesh_surface.find_nearest(p, view(eta), kFar, 0.0);
    ASSERT_TRUE(hit.has_value());
    mesh_surface.set_shape_functions(hit->place, Phi);
    EXPECT_LT((hit->place.x_B + Phi * eta - hit->nearest.point).norm(), 1e-14);
    for (int k = 0; k < 4; ++k) {
      VectorX ahead = eta;
      VectorX behind = eta;
      ahead[k] += kStep;
      behind[k] -= kStep;
      const double slope =
          (mesh_surface.find_nearest(p, view(ahead), kFar, 0.0)
               ->nearest.distance -
           mesh_surface.find_nearest(p, view(behind), kFar, 0.0)
               ->nearest.distance) /
          (2.0 * kStep);
      EXPECT_NEAR(slope, -hit->nearest.normal.dot(Phi.col(k)), 1e-8);
    }
  }
}

TEST(SurfaceNearest, BeyondTheBorderOfAnOpenSurfaceAllIsOutside) {
  const MeshSurface mesh_surface(test::make_sheet_surface(
      1.0, 4, true, [](double, double) { return 0.0; }));
  EXPECT_FALSE(mesh_surface.is_closed());
  for (const double height : {0.3, 0.0, -0.3}) {
    const auto hit =
        mesh_surface.find_nearest({1.4, 0.2, height}, view(kStill), 1.0, 1.0);
    ASSERT_TRUE(hit.has_value());
    EXPECT_NEAR(hit->nearest.distance, std::hypot(0.4, height), 1e-14);
  }
}

TEST(SurfaceNearest, BehindAnOpenSurfaceIsInsideAsFarAsItsThickness) {
  const MeshSurface mesh_surface(test::make_sheet_surface(
      1.0, 4, false, [](double, double) { return 0.0; }));
  const auto hit =
      mesh_surface.find_nearest({0.3, 0.2, -0.19}, view(kStill), 0.01, 0.2);
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(hit->nearest.distance, -0.19, 1e-15);
  EXPECT_EQ(hit->nearest.normal, Vector3(0, 0, 1));
  EXPECT_FALSE(
      mesh_surface.find_nearest({0.3, 0.2, -0.21}, view(kStill), 1.0, 0.2)
          .has_value());
  EXPECT_NEAR(mesh_surface.find_clearance({0.3, 0.2, -0.19}, 0.2, view(kStill)),
              -0.39, 1e-15);
  EXPECT_NEAR(mesh_surface.find_clearance({0.3, 0.2, -0.5}, 0.2, view(kStill)),
              0.3, 1e-15);
}

TEST(SurfaceNearest, DeepInsideAClosedSurfaceIsStillInside) {
  const MeshSurface mesh_surface(test::make_box_surface({1, 1, 1}, 2, false));
  const auto hit =
      mesh_surface.find_nearest({0.1, 0.0, 0.0}, view(kStill), 1e-3, 1e-3);
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(hit->nearest.distance, -0.9, 1e-15);
}

TEST(SurfaceNearest, FartherThanItsReachThereIsNone) {
  const MeshSurface mesh_surface(test::make_box_surface({1, 1, 1}, 2, false));
  EXPECT_TRUE(mesh_surface.find_nearest({1.09, 0, 0}, view(kStill), 0.1, 0.0));
  EXPECT_FALSE(mesh_surface.find_nearest({1.11, 0, 0}, view(kStill), 0.1, 0.0));
  EXPECT_FALSE(mesh_surface.find_nearest({50.0, 0, 0}, view(kStill), 0.1, 0.0));
}

TEST(SurfaceNearest, ClearanceFromFarAwayIsALowerBound) {
  const MeshSurface mesh_surface = make_flexible_ball(1, true);
  std::mt19937 random(7);
  for (int i = 0; i < 20; ++i) {
    const VectorX eta = draw_eta(random, 0.2);
    const Vector3 p = (2.0 + i) * test::draw_point(random, 1.0).normalized();
    const double distance =
        mesh_surface.find_nearest(p, view(eta), kFar, 0.0)->nearest.distance;
    const double clearance = mesh_surface.find_clearance(p, 0.1, view(eta));
    EXPECT_LE(clearance, distance - 0.1 + 1e-12);
    EXPECT_GT(clearance, 0.2 * distance - 0.3);
  }
}

TEST(SurfaceNearest, OfAStateThatIsNotFiniteIsNaN) {
  const MeshSurface mesh_surface = make_flexible_ball(0, true);
  const VectorX still = VectorX::Zero(4);
  VectorX broken = still;
  broken[2] = std::nan("");
  const Vector3 p(0.9, 0, 0);
  EXPECT_TRUE(std::isnan(
      mesh_surface.find_nearest(p, view(broken), 0.1, 0.1)->nearest.distance));
  EXPECT_TRUE(std::isnan(
      mesh_surface.find_nearest(p * broken[2], view(still), 0.1, 0.1)
          ->nearest.distance));
  EXPECT_TRUE(std::isnan(mesh_surface.find_clearance(p, 0.1, view(broken))));
}

}  // namespace
}  // namespace limber::contact::surface_nearest_test
