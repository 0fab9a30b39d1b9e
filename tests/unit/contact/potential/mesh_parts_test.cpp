// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/mesh_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "limber/common/rotation.hpp"
#include "limber/contact/potential/pair_potential.hpp"
#include "unit/contact/meshes.hpp"

namespace limber::contact::mesh_parts_test {
namespace {

constexpr double kModulus = 1e9;  // [Pa]

double sum_volumes(const std::vector<ConvexSolid>& parts) {
  double volume = 0.0;
  for (const ConvexSolid& part : parts) volume += part.find_volume();
  return volume;
}

Patch press(const ConvexSolid& A, const ConvexSolid& B, const Pose& X_B) {
  const PairPotential potential(PlacedBody{A, {}}, PlacedBody{B, {}}, kModulus);
  return potential.evaluate(
      {{Matrix3::Identity(), Vector3::Zero()}, {X_B.R, X_B.p}}, true);
}

// Lowest corner d below z = 0.
Pose lower(const ConvexSolid& solid, const Vector3& turn, double d) {
  Pose X{exp_rotation(turn), Vector3(0.01, -0.02, 0.0)};
  X.p.z() = -d - solid.find_low(X.R.transpose() * Vector3::UnitZ());
  return X;
}

const Vector3 kTurns[] = {
    {0.0, 0.0, 0.3}, {1e-4, -2e-4, 0.3}, {0.6, 0.0, 0.0}, {0.6, 0.4, 0.2}};

TEST(MeshParts, OfABoxAreTheBox) {
  const Vector3 half(0.05, 0.04, 0.03);
  const std::vector<ConvexSolid> parts = make_box_mesh(half).split();
  ASSERT_EQ(parts.size(), 1U);
  const ConvexSolid box(Box{half});
  for (const ConvexSolid& table :
       {ConvexSolid(HalfSpace{}), ConvexSolid(Box{Vector3(0.2, 0.3, 0.1)})}) {
    for (const Vector3& turn : kTurns) {
      Pose X = lower(box, turn, 1e-4);
      if (table.is_bounded()) X.p += Vector3(0.14, 0.0, 0.1);
      const Patch wanted = press(table, box, X);
      const Patch found = press(table, parts[0], X);
      ASSERT_TRUE(wanted.touches);
      EXPECT_NEAR(found.energy / wanted.energy, 1.0, 1e-10);
      const double load = wanted.load();
      EXPECT_LT((found.gradient_W - wanted.gradient_W).norm(), 1e-10 * load);
      EXPECT_LT((found.centre_W - wanted.centre_W).norm(), 1e-10);
      EXPECT_LT((found.hessian_W - wanted.hessian_W).norm(),
                1e-8 * wanted.hessian_W.norm());
    }
  }
}

// Of facets of which the sagitta is 1/20 of the depth.
TEST(MeshParts, OfAGlobeAreOneNearlyAsStiffAsTheBall) {
  const double R = 0.1;
  const std::vector<ConvexSolid> parts = make_globe(48, R).split();
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].faces().size(), 48U * 24U);
  const double sagitta = R * (1.0 - std::cos(std::numbers::pi / 48));
  const double d = 20.0 * sagitta;
  const double ball = kModulus / std::sqrt(std::numbers::pi) *
                      std::sqrt(0.4 * std::numbers::pi * R * std::pow(d, 5));
  for (const Vector3& turn : kTurns) {
    const Pose X = lower(parts[0], turn, d);
    const Patch patch = press(ConvexSolid(HalfSpace{}), parts[0], X);
    EXPECT_LT(patch.energy, 1.02 * ball);
    EXPECT_GT(patch.energy, 0.8 * ball);
  }
}

TEST(MeshParts, HaveTheGradientOfTheirEnergy) {
  const ConvexSolid globe = make_globe(16, 0.1).split().at(0);
  const ConvexSolid rod = make_rod(40, 0.05, 0.02).split().at(0);
  struct Case {
    ConvexSolid A, B;
    Pose X;
  };
  Pose above = lower(rod, {0.0, 0.0, 0.1}, 1e-3);
  above.p += Vector3(-0.01, 0.02, 0.02);
  std::vector<Case> cases{
      {ConvexSolid(HalfSpace{}), globe, lower(globe, {0.3, 0.2, 0.1}, 3e-3)},
      {ConvexSolid(HalfSpace{}), rod, lower(rod, {1e-3, 0, 0.1}, 1e-3)},
      {rod, rod, above},
      {globe, globe, {exp_rotation(Vector3(0.4, 1.0, 0.2)), {0.1, 0.1, 0.1}}}};
  for (const Case& at : cases) {
    const Patch patch = press(at.A, at.B, at.X);
    ASSERT_TRUE(patch.touches);
    const auto energy = [&](int i, double by) {
      const Vector6 motion = by * Vector6::Unit(i);
      const Matrix3 R = exp_rotation(motion.tail<3>());
      const Vector3 p =
          patch.centre_W + motion.head<3>() + R * (at.X.p - patch.centre_W);
      return press(at.A, at.B, {R * at.X.R, p}).energy;
    };
    for (int i = 0; i < 6; ++i) {
      const double h = i < 3 ? 1e-7 : 1e-6;
      const double slope = (energy(i, h) - energy(i, -h)) / (2.0 * h);
      EXPECT_NEAR(slope, patch.gradient_W[i], 1e-5 * patch.load()) << i;
    }
  }
}

TEST(MeshParts, FillTheInsideOfOpenShapes) {
  const std::vector<ConvexSolid> angle = make_angle().split();
  EXPECT_EQ(angle.size(), 2U);
  EXPECT_NEAR(sum_volumes(angle), 0.06 * (0.08 * 0.02 + 0.06 * 0.02), 1e-15);
  const std::vector<ConvexSolid> channel = make_channel().split();
  EXPECT_EQ(channel.size(), 3U);
  EXPECT_NEAR(sum_volumes(channel), 0.1 * (0.1 * 0.06 - 0.06 * 0.04), 1e-15);
  const int n = 24;
  const std::vector<ConvexSolid> ring = make_ring(n, 0.05, 0.08, 0.02).split();
  EXPECT_EQ(ring.size(), static_cast<std::size_t>(n));
  const double area = 0.5 * n * std::sin(2.0 * std::numbers::pi / n) *
                      (0.08 * 0.08 - 0.05 * 0.05);
  EXPECT_NEAR(sum_volumes(ring), 0.04 * area, 1e-12);
}

// Turned, moved, in millimetres, and with its triangles in the opposite order.
TEST(MeshParts, DoNotDependOnAxesUnitsAndOrder) {
  for (const TestMesh& mesh : {make_angle(), make_channel()}) {
    const std::vector<ConvexSolid> parts = mesh.split();
    TestMesh other = mesh.place(
        {exp_rotation(Vector3(0.3, -1.0, 2.0)), Vector3(400, -300, 100)}, 1e3);
    std::ranges::reverse(other.faces);
    std::vector<double> volumes;
    std::vector<double> others;
    for (const ConvexSolid& part : parts) volumes.push_back(part.find_volume());
    for (const ConvexSolid& part : other.split()) {
      others.push_back(1e-9 * part.find_volume());
    }
    std::ranges::sort(volumes);
    std::ranges::sort(others);
    ASSERT_EQ(volumes.size(), others.size());
    for (std::size_t i = 0; i < volumes.size(); ++i) {
      EXPECT_NEAR(others[i] / volumes[i], 1.0, 1e-9);
    }
  }
}

// Round punches of their areas [Johnson 1985], side by side.
TEST(MeshParts, OfAFlatAreAsStiffAsTheirAreasSideBySide) {
  const double d = 1e-8;
  double load = 0.0;
  double punches = 0.0;
  for (const ConvexSolid& part : make_ring(24, 0.05, 0.08, 0.02).split()) {
    const Pose X{Matrix3::Identity(), Vector3(0.0, 0.0, 0.02 - d)};
    load += press(ConvexSolid(HalfSpace{}), part, X).load();
    const double area = part.find_volume() / 0.04;
    punches += 2.0 * kModulus * std::sqrt(area / std::numbers::pi) * d;
  }
  EXPECT_NEAR(load / punches, 1.0, 1e-4);
}

TEST(MeshParts, AreNotMadeOfTooManyFacesOrParts) {
  EXPECT_TRUE(make_globe(100, 1.0).split().empty());
  // Side by side under its end.
  EXPECT_FALSE(make_ring(32, 0.05, 0.08, 0.02).split().empty());
  EXPECT_TRUE(make_ring(33, 0.05, 0.08, 0.02).split().empty());
}

}  // namespace
}  // namespace limber::contact::mesh_parts_test
