// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/solids.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace limber::results::solids_test {
namespace {

/// Volume, centre times volume, and second moments, by the divergence theorem
/// over outward triangles.
struct Moments {
  double volume = 0.0;
  Vector3 first = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();
};

Moments integrate(const Solid& solid) {
  Moments all;
  for (std::size_t i = 0; i < solid.corners.size(); i += 3) {
    Matrix3 x;
    for (std::size_t k = 0; k < 3; ++k) {
      x.col(static_cast<Eigen::Index>(k)) = solid.x.col(solid.corners[i + k]);
    }
    const double tetrahedron = x.determinant() / 6.0;
    const Vector3 sum = x.rowwise().sum();
    all.volume += tetrahedron;
    all.first += tetrahedron * sum / 4.0;
    all.second +=
        tetrahedron / 20.0 * (x * x.transpose() + sum * sum.transpose());
  }
  return all;
}

SolidShape make_shape(const char* kind, const Vector3& size) {
  return {kind, size, {}, {}};
}

// Chords of a circle in 24, arcs in 12: volumes are a few percent too small.
constexpr double kChords = 0.03;

TEST(Solids, HaveTheVolumesOfTheirShapes) {
  const double pi = std::numbers::pi;
  EXPECT_NEAR(
      integrate(make_solid(make_shape("box", {1.0, 2.0, 3.0}), 1.0)).volume,
      6.0, 1e-12);
  EXPECT_NEAR(
      integrate(make_solid(make_shape("sphere", {2.0, 0.0, 0.0}), 1.0)).volume /
          (32.0 / 3.0 * pi),
      1.0, kChords);
  EXPECT_NEAR(
      integrate(make_solid(make_shape("cylinder", {0.5, 3.0, 0.0}), 1.0))
              .volume /
          (0.75 * pi),
      1.0, kChords);
  EXPECT_NEAR(integrate(make_solid(make_shape("capsule", {0.5, 3.0, 0.0}), 1.0))
                      .volume /
                  (0.75 * pi + pi / 6.0),
              1.0, kChords);
  EXPECT_NEAR(
      integrate(make_solid(make_shape("cone", {0.5, 3.0, 0.0}), 1.0)).volume /
          (0.25 * pi),
      1.0, kChords);
  EXPECT_NEAR(
      integrate(make_solid(make_shape("ellipsoid", {1.0, 2.0, 3.0}), 1.0))
              .volume /
          (8.0 * pi),
      1.0, kChords);
}

TEST(Solids, AreWhereTheyArePlaced) {
  const Matrix3 R = Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3::UnitX())
                        .toRotationMatrix();
  const Vector3 p(0.3, -0.2, 0.7);
  const Solid solid =
      place_solid(make_solid(make_shape("box", {1.0, 2.0, 3.0}), 1.0), {R, p});
  const Moments moments = integrate(solid);
  EXPECT_LT((moments.first / moments.volume - p).norm(), 1e-12);
  const Vector3 edges =
      solid.x.rowwise().maxCoeff() - solid.x.rowwise().minCoeff();
  EXPECT_LT((edges - Vector3(1.0, 3.0, 2.0)).norm(), 1e-12);
}

TEST(Solids, OfMeshesAreTheirTriangles) {
  SolidShape shape = make_shape("mesh", Vector3::Zero());
  shape.x.resize(3, 4);
  shape.x << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  shape.corners = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  EXPECT_NEAR(integrate(make_solid(shape, 1.0)).volume, 1.0 / 6.0, 1e-15);
}

TEST(Ellipsoid, HasTheInertiaThatItStandsFor) {
  const Matrix3 R =
      Quaternion(0.8, 0.2, -0.4, 0.4).normalized().toRotationMatrix();
  const Matrix3 J = R * Vector3(0.9, 1.1, 1.6).asDiagonal() * R.transpose();
  const double mass = 3.0;
  const Moments moments = integrate(make_ellipsoid(mass, J));
  ASSERT_GT(moments.volume, 0.0);
  const Matrix3 S = mass / moments.volume * moments.second;
  const Matrix3 found = S.trace() * Matrix3::Identity() - S;
  EXPECT_LT((found - J).norm() / J.norm(), kChords);
}

}  // namespace
}  // namespace limber::results::solids_test
