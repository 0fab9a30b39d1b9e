// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <variant>
#include <vector>

#include "limber/common/rotation.hpp"
#include "limber/contact/patches/patch_pair.hpp"
#include "limber/contact/patches/surface_parts.hpp"
#include "limber/contact/shapes/mesh_surface.hpp"

/// Surfaces of round meshes: which bodies stand for their slices, and what
/// these do against others.
namespace limber::contact::round_surface_test {
namespace {

using joints::PairBody;
using std::numbers::pi;

const double kModulus = 70e9;

struct Ring {
  double z = 0.0;
  double r = 0.0;
};

/// A profile turned about z, of n sides, in a frame at X.
flexbody::ContactSurface revolve(const std::vector<Ring>& profile, int n,
                                 const Pose& X = {}) {
  flexbody::ContactSurface mesh_surface;
  mesh_surface.name = "skin";
  std::vector<Vector3> points;
  std::vector<std::vector<int>> rings;
  for (const Ring& ring : profile) {
    std::vector<int>& own = rings.emplace_back();
    for (int i = 0; i < n; ++i) {
      if (ring.r > 0.0 || i == 0) {
        const double a = 2.0 * pi * i / n;
        points.emplace_back(
            X * Vector3(ring.r * std::cos(a), ring.r * std::sin(a), ring.z));
      }
      own.push_back(static_cast<int>(points.size()) - 1);
    }
  }
  const auto add = [&](int a, int b, int c) {
    if (a != b && b != c && c != a)
      mesh_surface.faces.push_back({a, b, c, -1, -1, -1});
  };
  for (std::size_t k = 0; k + 1 < rings.size(); ++k) {
    for (int i = 0; i < n; ++i) {
      const auto here = static_cast<std::size_t>(i);
      const auto next = static_cast<std::size_t>((i + 1) % n);
      add(rings[k][here], rings[k][next], rings[k + 1][next]);
      add(rings[k][here], rings[k + 1][next], rings[k + 1][here]);
    }
  }
  const auto count = static_cast<Eigen::Index>(points.size());
  mesh_surface.x_B.resize(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    mesh_surface.x_B.col(i) = points[static_cast<std::size_t>(i)];
    mesh_surface.tags.push_back(static_cast<std::size_t>(i) + 1);
  }
  mesh_surface.Phi_B.resize(3 * count, 0);
  mesh_surface.residual = VectorX::Zero(count);
  mesh_surface.patch_radius = VectorX::Constant(count, 0.01);
  mesh_surface.youngs_modulus = kModulus;
  mesh_surface.poisson_ratio = 0.3;
  return mesh_surface;
}

// Planes z = at part the slices, without modes.
void cut_along_z(const std::vector<double>& at, const Pose& X,
                 flexbody::ContactSurface& mesh_surface) {
  for (std::size_t i = 0; i <= at.size(); ++i) {
    flexbody::ContactSlice slice;
    slice.normals_B.resize(3, 0);
    slice.motion_B.resize(6, 0);
    const auto add = [&](double sign, double z) {
      const Eigen::Index k = slice.heights.size();
      slice.normals_B.conservativeResize(3, k + 1);
      slice.heights.conservativeResize(k + 1);
      const Vector3 n = sign * X.R.col(2);
      slice.normals_B.col(k) = n;
      slice.heights[k] = n.dot(X * Vector3(0.0, 0.0, z));
    };
    if (i > 0) add(-1.0, at[i - 1]);
    if (i < at.size()) add(1.0, at[i]);
    slice.centre_B = Vector3(0.01 * static_cast<double>(i), 0.002, -0.001);
    mesh_surface.slices.push_back(slice);
  }
}

const Pose kTurned{exp_rotation({0.3, -0.5, 0.2}), {0.1, -0.2, 0.3}};

std::vector<Ring> make_rod(double r, double h, int cells) {
  std::vector<Ring> profile{{-h, 0.0}};
  for (int i = 0; i <= cells; ++i) {
    profile.push_back({-h + 2.0 * h * i / cells, r});
  }
  profile.push_back({h, 0.0});
  return profile;
}

// From the pole at `low` on, or from a rim.
std::vector<Ring> make_capsule(double r, double h, bool is_low_round) {
  std::vector<Ring> profile;
  const int n = 12;
  if (!is_low_round) profile.push_back({-h, 0.0});
  for (int i = is_low_round ? 0 : n; i <= n; ++i) {
    const double a = 0.5 * pi * i / n;
    profile.push_back({-h - r * std::cos(a), i == 0 ? 0.0 : r * std::sin(a)});
  }
  if (!is_low_round) profile.back() = {-h, r};
  for (int i = 1; i < 10; ++i) profile.push_back({-h + 0.2 * h * i, r});
  for (int i = 0; i <= n; ++i) {
    const double a = 0.5 * pi * i / n;
    profile.push_back({h + r * std::sin(a), i == n ? 0.0 : r * std::cos(a)});
  }
  return profile;
}

TEST(RoundSurface, OfARodIsACylinderInEachSlice) {
  for (const int sides : {20, 48}) {
    auto mesh_surface = revolve(make_rod(0.02, 0.1, 10), sides, kTurned);
    cut_along_z({-0.03, 0.04}, kTurned, mesh_surface);
    const SurfaceParts parts = split_surface(mesh_surface);
    ASSERT_EQ(parts.bodies.size(), 3U);
    EXPECT_LT(parts.error, 1e-9);
    const double ends[] = {-0.1, -0.03, 0.04, 0.1};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto* rod = std::get_if<Cylinder>(&parts.bodies[i].kind);
      ASSERT_NE(rod, nullptr) << i;
      EXPECT_NEAR(rod->radius, 0.02, 1e-9);
      EXPECT_NEAR(rod->half_length, 0.5 * (ends[i + 1] - ends[i]), 1e-9);
      const Vector3 middle(0.0, 0.0, 0.5 * (ends[i + 1] + ends[i]));
      EXPECT_LT((parts.bodies[i].X_BS.p - kTurned * middle).norm(), 1e-9);
      EXPECT_NEAR(std::abs(parts.bodies[i].X_BS.R.col(2).dot(
                      Vector3(kTurned.R.col(2)))),
                  1.0, 1e-9);
    }
  }
}

TEST(RoundSurface, OfAPrismOfTwelveSidesIsItself) {
  auto mesh_surface = revolve(make_rod(0.02, 0.1, 4), 12);
  cut_along_z({}, {}, mesh_surface);
  const SurfaceParts parts = split_surface(mesh_surface);
  ASSERT_EQ(parts.bodies.size(), 1U);
  EXPECT_EQ(std::get<ConvexSolid>(parts.bodies[0].kind).faces().size(), 14U);
}

TEST(RoundSurface, OfATubeIsACylinderAndItsWallAnError) {
  std::vector<Ring> profile;
  for (int i = 0; i <= 5; ++i) profile.push_back({-0.1 + 0.04 * i, 0.02});
  for (int i = 0; i <= 5; ++i) profile.push_back({0.1 - 0.04 * i, 0.015});
  profile.push_back(profile.front());
  auto mesh_surface = revolve(profile, 32);
  cut_along_z({0.01}, {}, mesh_surface);
  const SurfaceParts parts = split_surface(mesh_surface);
  ASSERT_EQ(parts.bodies.size(), 2U);
  EXPECT_NE(std::get_if<Cylinder>(&parts.bodies[0].kind), nullptr);
  EXPECT_NEAR(parts.error, 0.005, 1e-9);
}

TEST(RoundSurface, OfACapsuleAndABallAreThese) {
  auto mesh_surface = revolve(make_capsule(0.02, 0.06, true), 32, kTurned);
  cut_along_z({}, kTurned, mesh_surface);
  const SurfaceParts whole = split_surface(mesh_surface);
  ASSERT_EQ(whole.bodies.size(), 1U);
  const auto* capsule = std::get_if<Capsule>(&whole.bodies[0].kind);
  ASSERT_NE(capsule, nullptr);
  EXPECT_NEAR(capsule->radius, 0.02, 1e-9);
  EXPECT_NEAR(capsule->half_length, 0.06, 1e-9);

  std::vector<Ring> profile;
  for (int i = 0; i <= 16; ++i) {
    const double a = pi * i / 16;
    profile.push_back(
        {-0.03 * std::cos(a), i % 16 == 0 ? 0.0 : 0.03 * std::sin(a)});
  }
  auto ball = revolve(profile, 32, kTurned);
  cut_along_z({}, kTurned, ball);
  const SurfaceParts parts = split_surface(ball);
  ASSERT_EQ(parts.bodies.size(), 1U);
  const auto* sphere = std::get_if<Sphere>(&parts.bodies[0].kind);
  ASSERT_NE(sphere, nullptr);
  EXPECT_NEAR(sphere->radius, 0.03, 1e-9);
  EXPECT_LT((parts.bodies[0].X_BS.p - kTurned.p).norm(), 1e-9);
}

// A finger: a cylinder, and at its tip a capsule that goes on into it.
TEST(RoundSurface, OfAFingerIsRoundAtItsTip) {
  auto mesh_surface = revolve(make_capsule(0.02, 0.06, false), 32, kTurned);
  cut_along_z({0.0}, kTurned, mesh_surface);
  const SurfaceParts parts = split_surface(mesh_surface);
  ASSERT_EQ(parts.bodies.size(), 2U);
  EXPECT_LT(parts.error, 1e-9);
  const auto* rod = std::get_if<Cylinder>(&parts.bodies[0].kind);
  const auto* tip = std::get_if<Capsule>(&parts.bodies[1].kind);
  ASSERT_NE(rod, nullptr);
  ASSERT_NE(tip, nullptr);
  EXPECT_NEAR(rod->half_length, 0.03, 1e-9);
  EXPECT_NEAR(tip->half_length, 0.03, 1e-9);
  EXPECT_NEAR(tip->radius, 0.02, 1e-9);
}

// An egg is none of these: a hull of few faces, no farther out than its
// error says.
TEST(RoundSurface, OfAnEggIsAHull) {
  std::vector<Ring> profile;
  for (int i = 0; i <= 24; ++i) {
    const double a = pi * i / 24;
    profile.push_back(
        {-0.05 * std::cos(a), i % 24 == 0 ? 0.0 : 0.03 * std::sin(a)});
  }
  auto mesh_surface = revolve(profile, 48);
  cut_along_z({0.0}, {}, mesh_surface);
  const SurfaceParts parts = split_surface(mesh_surface);
  ASSERT_EQ(parts.bodies.size(), 2U);
  EXPECT_GT(parts.error, 1e-5);
  EXPECT_LT(parts.error, 2e-3);
  for (const PlacedBody& body : parts.bodies) {
    const auto& solid = std::get<ConvexSolid>(body.kind);
    EXPECT_LE(solid.faces().size(), 103U);
    // Of half the egg.
    const double volume = 2.0 / 3.0 * pi * 0.05 * 0.03 * 0.03;
    EXPECT_GT(solid.find_volume() / volume, 0.98);
    EXPECT_LT(solid.find_volume() / volume, 1.06);
  }
}

// A surface of slices that are not across its axis.
TEST(RoundSurface, CutAlongItsAxisIsAHull) {
  auto mesh_surface = revolve(make_rod(0.05, 0.005, 1), 48);
  flexbody::ContactSlice half;
  half.motion_B.resize(6, 0);
  half.normals_B = Vector3::UnitX();
  half.heights = VectorX::Zero(1);
  mesh_surface.slices.push_back(half);
  half.normals_B = -Vector3::UnitX();
  mesh_surface.slices.push_back(half);
  const SurfaceParts parts = split_surface(mesh_surface);
  ASSERT_EQ(parts.bodies.size(), 2U);
  EXPECT_LT(parts.error, 1e-9);
  double volume = 0.0;
  for (const PlacedBody& body : parts.bodies) {
    volume += std::get<ConvexSolid>(body.kind).find_volume();
  }
  const double facets = 24.0 * std::sin(2.0 * pi / 48) * 0.05 * 0.05 * 0.01;
  EXPECT_NEAR(volume / facets, 1.0, 1e-6);
}

ContactSide make_side(const flexbody::ContactSurface& mesh_surface) {
  SurfaceParts parts = split_surface(mesh_surface);
  return {.shape = {std::make_shared<const MeshSurface>(mesh_surface), {}},
          .material = SurfaceMaterial{kModulus, 0.3},
          .mass = 1.0,
          .inertia_B = Matrix3::Identity(),
          .bodies = std::move(parts.bodies),
          .slices = std::move(parts.slices)};
}

ContactSide make_rigid(const ShapeKind& kind, const Pose& X = {}) {
  return {.shape = {kind, X},
          .material = SurfaceMaterial{kModulus, 0.3},
          .mass = 1.0,
          .inertia_B = Matrix3::Identity()};
}

struct Sum {
  double energy = 0.0;
  Vector3 force = Vector3::Zero();
};

Sum evaluate(const PatchPair& pair, const PairBody& A, const PairBody& B) {
  joints::PairResponse out(pair.most_points(), 0, 0, true);
  const std::vector<double> memory(pair.memory_size(), 0.0);
  pair.evaluate({A, B}, {0.0, Side::right}, memory, out);
  Sum sum{out.energy};
  for (const joints::PairPoint& point : out.points())
    sum.force += point.force_W;
  return sum;
}

flexbody::ContactSurface make_rod_surface(const std::vector<double>& at) {
  auto mesh_surface = revolve(make_rod(0.02, 0.1, 10), 32);
  cut_along_z(at, {}, mesh_surface);
  return mesh_surface;
}

const double kEffective = kModulus / (2.0 * (1.0 - 0.09));  // E*

// Crossed at the middle of a slice: a ball of the same radius on a plane.
TEST(RoundSurface, CrossedIsHertz) {
  const double d = 2e-6;
  const auto mesh_surface = make_rod_surface({-0.03, 0.04});
  const PatchPair pair(make_side(mesh_surface), make_side(mesh_surface), {});
  const PairBody A;
  const PairBody B{exp_rotation({0.0, 0.5 * pi, 0.0}),
                   Vector3(-0.005, 0.04 - d, 0.005)};
  const double N = 4.0 / 3.0 * kEffective * std::sqrt(0.02) * d * std::sqrt(d);
  const Sum sum = evaluate(pair, A, B);
  EXPECT_NEAR(sum.force.norm() / N, 1.0, 0.01);
  const Sum swapped = evaluate(pair, B, A);
  EXPECT_NEAR(swapped.energy / sum.energy, 1.0, 1e-9);
  EXPECT_LT((swapped.force + sum.force).norm(), 1e-9 * N);
}

// N by depth of a line [johnson1985, 5.3 and 10], of length 0.2 as a
// rectangle's mean: d = (2 N / (pi L E*)) (ln(2 L / b) + 1/2), b^2 = 4 N R /
// (pi L E*).
TEST(RoundSurface, AlongAnotherIsALineOfContact) {
  const double L = 0.2;
  for (const double d : {1e-6, 1e-5}) {
    double low = 0.0;
    double high = kEffective * L * d;
    for (int i = 0; i < 100; ++i) {
      const double N = 0.5 * (low + high);
      const double b = std::sqrt(4.0 * N * 0.01 / (pi * L * kEffective));
      const double depth =
          2.0 * N / (pi * L * kEffective) * (std::log(2.0 * L / b) + 0.5);
      (depth < d ? low : high) = N;
    }
    for (const std::vector<double>& at :
         {std::vector<double>{}, {0.0}, {-0.05, 0.0, 0.05}}) {
      const auto mesh_surface = make_rod_surface(at);
      const PatchPair pair(make_side(mesh_surface),
                           make_rigid(Cylinder{0.02, 0.1}), {});
      const PairBody B{Matrix3::Identity(), Vector3(0.04 - d, 0.0, 0.0)};
      const Sum sum = evaluate(pair, {}, B);
      const double ratio = sum.force.norm() / low;
      EXPECT_GT(ratio, 0.88) << at.size() << ' ' << d;
      // Slices are springs side by side.
      const double most = std::sqrt(static_cast<double>(at.size()) + 1.0);
      EXPECT_LT(ratio, 1.12 * most) << at.size() << ' ' << d;
    }
  }
}

// Of one slice it is the same as the shape; of several, where one alone
// touches.
TEST(RoundSurface, TouchesAsTheCylinder) {
  const std::vector<std::pair<ShapeKind, PairBody>> others{
      {Box{{0.05, 0.04, 0.03}},
       {exp_rotation({0.1, 0.2, 0.3}), Vector3(0.068, 0.0, -0.08)}},
      {Box{{0.3, 0.3, 0.03}}, {Matrix3::Identity(), {0.0, 0.0, 0.12999}}},
      {HalfSpace{}, {exp_rotation({0.0, 0.5 * pi, 0.0}), {-0.01999, 0, 0}}},
      {Capsule{0.01, 0.05},
       {exp_rotation({0.5 * pi, 0.0, 0.0}), Vector3(0.02999, 0.0, 0.07)}}};
  for (const auto& [kind, B] : others) {
    const PatchPair rigid(make_rigid(Cylinder{0.02, 0.1}), make_rigid(kind),
                          {});
    const Sum expected = evaluate(rigid, {}, B);
    EXPECT_GT(expected.energy, 0.0);
    const PatchPair pair(make_side(make_rod_surface({})), make_rigid(kind), {});
    const Sum sum = evaluate(pair, {}, B);
    EXPECT_NEAR(sum.energy / expected.energy, 1.0, 1e-5);
    EXPECT_LT((sum.force - expected.force).norm(),
              1e-5 * expected.force.norm());
    const Matrix3 R = exp_rotation({0.7, -0.4, 1.1});
    const Vector3 p(1000.0, -300.0, 50.0);
    const Sum far =
        evaluate(pair, {R, p}, {Matrix3(R * B.R_WB), Vector3(p + R * B.p_WB)});
    EXPECT_NEAR(far.energy / expected.energy, 1.0, 1e-5);
  }
}

}  // namespace
}  // namespace limber::contact::round_surface_test
