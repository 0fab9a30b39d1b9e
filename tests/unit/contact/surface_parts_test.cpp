// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/surface_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <variant>
#include <vector>

#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"
#include "limber/contact/patches/patch_pair.hpp"
#include "limber/contact/shapes/mesh_surface.hpp"
#include "unit/contact/meshes.hpp"

/// Whole surfaces of flexible bodies: their solids, and their potential against
/// that of the same shapes when rigid.
namespace limber::contact::surface_parts_test {
namespace {

using joints::PairBody;

const double kModulus = 70e9;

/// The walls of a body of square cells along x and z, from y = -0.5 w to 0.5 w.
flexbody::ContactSurface make_mesh_surface(
    const std::vector<std::pair<int, int>>& cells, double cell, double w) {
  flexbody::ContactSurface mesh_surface;
  mesh_surface.name = "skin";
  std::vector<Vector3> points;
  const auto find = [&](const Vector3& x) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if ((points[i] - x).norm() < 1e-9) return static_cast<int>(i);
    }
    points.push_back(x);
    return static_cast<int>(points.size()) - 1;
  };
  const auto has = [&](int i, int k) {
    return std::ranges::find(cells, std::pair(i, k)) != cells.end();
  };
  const auto add = [&](const Vector3& a, const Vector3& b, const Vector3& c,
                       const Vector3& d) {
    mesh_surface.faces.push_back({find(a), find(b), find(c), -1, -1, -1});
    mesh_surface.faces.push_back({find(a), find(c), find(d), -1, -1, -1});
  };
  const double h = 0.5 * w;
  for (const auto& [i, k] : cells) {
    const double x = i * cell;
    const double X = x + cell;
    const double z = k * cell;
    const double Z = z + cell;
    add({x, -h, z}, {X, -h, z}, {X, -h, Z}, {x, -h, Z});
    add({x, h, z}, {x, h, Z}, {X, h, Z}, {X, h, z});
    if (!has(i - 1, k)) add({x, -h, z}, {x, -h, Z}, {x, h, Z}, {x, h, z});
    if (!has(i + 1, k)) add({X, -h, z}, {X, h, z}, {X, h, Z}, {X, -h, Z});
    if (!has(i, k - 1)) add({x, -h, z}, {x, h, z}, {X, h, z}, {X, -h, z});
    if (!has(i, k + 1)) add({x, -h, Z}, {X, -h, Z}, {X, h, Z}, {x, h, Z});
  }
  const auto n = static_cast<Eigen::Index>(points.size());
  mesh_surface.x_B.resize(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    mesh_surface.x_B.col(i) = points[static_cast<std::size_t>(i)];
    mesh_surface.tags.push_back(static_cast<std::size_t>(i) + 1);
  }
  mesh_surface.Phi_B.resize(3 * n, 0);
  mesh_surface.residual = VectorX::Zero(n);
  mesh_surface.patch_radius = VectorX::Constant(n, cell);
  mesh_surface.youngs_modulus = kModulus;
  mesh_surface.poisson_ratio = 0.3;
  return mesh_surface;
}

std::vector<std::pair<int, int>> make_row(int count) {
  std::vector<std::pair<int, int>> cells;
  for (int i = 0; i < count; ++i) cells.emplace_back(i, 0);
  return cells;
}

// Planes x = at part the slices, without modes.
void cut_along_x(const std::vector<double>& at,
                 flexbody::ContactSurface& mesh_surface) {
  for (std::size_t i = 0; i <= at.size(); ++i) {
    flexbody::ContactSlice slice;
    const auto add = [&](double sign, double x) {
      const Eigen::Index k = slice.heights.size();
      slice.normals_B.conservativeResize(3, k + 1);
      slice.heights.conservativeResize(k + 1);
      slice.normals_B.col(k) = sign * Vector3::UnitX();
      slice.heights[k] = sign * x;
    };
    slice.normals_B.resize(3, 0);
    slice.motion_B.resize(6, 0);
    if (i > 0) add(-1.0, at[i - 1]);
    if (i < at.size()) add(1.0, at[i]);
    slice.centre_B = Vector3(0.01 * static_cast<double>(i), 0.002, -0.001);
    mesh_surface.slices.push_back(slice);
  }
}

double sum_volumes(const SurfaceParts& mesh_surface) {
  double sum = 0.0;
  for (const PlacedBody& body : mesh_surface.bodies) {
    sum += std::get<ConvexSolid>(body.kind).find_volume();
  }
  return sum;
}

TEST(SurfaceParts, OfABarAreItsSlices) {
  flexbody::ContactSurface mesh_surface =
      make_mesh_surface(make_row(5), 0.02, 0.03);
  EXPECT_TRUE(split_surface(mesh_surface).bodies.empty());
  cut_along_x({0.03, 0.06}, mesh_surface);
  const SurfaceParts solids = split_surface(mesh_surface);
  EXPECT_EQ(solids.slices, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_NEAR(sum_volumes(solids), 0.1 * 0.02 * 0.03, 1e-15);
  EXPECT_EQ(solids.error, 0.0);
  const auto count = [](const PlacedBody& body) {
    return std::ranges::count_if(
        std::get<ConvexSolid>(body.kind).faces(),
        [](const ConvexSolid::Face& f) { return f.presses; });
  };
  EXPECT_EQ(count(solids.bodies[0]), 5);
  EXPECT_EQ(count(solids.bodies[1]), 4);
  EXPECT_EQ(count(solids.bodies[2]), 5);
}

TEST(SurfaceParts, OfAnAngleAreThoseOfBothLegs) {
  auto cells = make_row(4);
  for (int k = 1; k < 4; ++k) cells.emplace_back(0, k);
  flexbody::ContactSurface mesh_surface = make_mesh_surface(cells, 0.02, 0.03);
  cut_along_x({0.05}, mesh_surface);
  const SurfaceParts solids = split_surface(mesh_surface);
  EXPECT_NEAR(sum_volumes(solids), 7 * 0.02 * 0.02 * 0.03, 1e-15);
  EXPECT_EQ(solids.bodies.size(), 3U);
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

const Vector3 kHalf(0.05, 0.015, 0.01);

ContactSide make_box() {
  return {.shape = {Box{kHalf}, {Matrix3::Identity(), {0.05, 0.0, 0.01}}},
          .material = SurfaceMaterial{kModulus, 0.3},
          .mass = 1.0,
          .inertia_B = Matrix3::Identity()};
}

struct Sum {
  double energy = 0.0;
  Vector3 force = Vector3::Zero();
  Vector3 moment = Vector3::Zero();  // about the world's origin
};

Sum evaluate(const PatchPair& pair, const PairBody& A, const PairBody& B) {
  joints::PairResponse out(pair.most_points(), 0, 0, true);
  const std::vector<double> memory(pair.memory_size(), 0.0);
  pair.evaluate({A, B}, {0.0, Side::right}, memory, out);
  Sum sum{out.energy};
  for (const joints::PairPoint& point : out.points()) {
    sum.force += point.force_W;
    sum.moment += find_position(B, point.on_B).cross(point.force_W);
  }
  return sum;
}

void expect_same(const Sum& one, const Sum& other, double tolerance) {
  ASSERT_GT(one.energy, 0.0);
  EXPECT_NEAR(other.energy / one.energy, 1.0, tolerance);
  EXPECT_LT((other.force - one.force).norm(), tolerance * one.force.norm());
  EXPECT_LT((other.moment - one.moment).norm(), tolerance * one.moment.norm());
}

std::vector<PairBody> list_touches() {
  std::vector<PairBody> all;
  const ConvexSolid solid(Box{kHalf});
  for (const Vector3& turn : {Vector3(0, 0, 0), Vector3(1e-3, 2e-3, 0.4),
                              Vector3(0.3, 0.4, 0.1), Vector3(0, 0.5, 0)}) {
    PairBody B{exp_rotation(turn), Vector3(0.02, 0.003, 0.0)};
    double low = 1.0;
    for (const Vector3& x : solid.corners()) {
      low = std::min(low, (B.R_WB * (x + Vector3(0.05, 0.0, 0.01))).z());
    }
    B.p_WB.z() = -low - 1e-5;
    all.push_back(B);
  }
  return all;
}

// On a block of which the top is z = 0.
TEST(SurfaceParts, OfABoxInOneSliceTouchAsTheBox) {
  flexbody::ContactSurface mesh_surface =
      make_mesh_surface(make_row(5), 0.02, 0.03);
  cut_along_x({}, mesh_surface);
  const ContactSide block{
      .shape = {Box{{0.3, 0.2, 0.1}}, {Matrix3::Identity(), {0, 0, -0.1}}},
      .material = SurfaceMaterial{kModulus, 0.3},
      .mass = 2.0,
      .inertia_B = Matrix3::Identity()};
  const PatchPair of_surface(block, make_side(mesh_surface), {});
  const PatchPair of_box(block, make_box(), {});
  for (const PairBody& B : list_touches()) {
    expect_same(evaluate(of_box, {}, B), evaluate(of_surface, {}, B), 1e-9);
  }
}

// A slice far from the place of a touch changes nothing, moved, turned or with
// the other name first.
TEST(SurfaceParts, TouchAloneWhereTheyAre) {
  flexbody::ContactSurface whole = make_mesh_surface(make_row(5), 0.02, 0.03);
  cut_along_x({}, whole);
  flexbody::ContactSurface cut = make_mesh_surface(make_row(5), 0.02, 0.03);
  cut_along_x({0.05}, cut);
  const ContactSide block{
      .shape = {Box{{0.3, 0.2, 0.1}}, {Matrix3::Identity(), {0, 0, -0.1}}},
      .material = SurfaceMaterial{kModulus, 0.3},
      .mass = 2.0,
      .inertia_B = Matrix3::Identity()};
  const PatchPair of_whole(block, make_side(whole), {});
  const PatchPair of_cut(block, make_side(cut), {});
  const PatchPair other(make_side(cut), block, {});
  const PairBody B = list_touches()[2];
  const Sum expected = evaluate(of_whole, {}, B);
  expect_same(expected, evaluate(of_cut, {}, B), 1e-9);
  Sum swapped = evaluate(other, B, {});
  swapped.force *= -1.0;
  swapped.moment *= -1.0;
  expect_same(expected, swapped, 1e-9);
  const Matrix3 R = exp_rotation({0.7, -0.4, 1.1});
  const Vector3 p(1000.0, -300.0, 50.0);
  const PairBody far_A{R, p};
  const PairBody far_B{R * B.R_WB, p + R * B.p_WB};
  const Sum far = evaluate(of_cut, far_A, far_B);
  EXPECT_NEAR(far.energy / expected.energy, 1.0, 1e-6);
  EXPECT_LT((R.transpose() * far.force - expected.force).norm(),
            1e-6 * expected.force.norm());
}

double find_volume(const SurfaceParts& parts) {
  double volume = 0.0;
  for (const PlacedBody& body : parts.bodies) {
    volume += std::get<ConvexSolid>(body.kind).find_volume();
  }
  return volume;
}

// It has too many planes for a cylinder beside it, hulls have up to 108 each.
TEST(MeshCover, OfAGlobeIsTheGlobe) {
  constexpr double kRadius = 0.1;
  const TestMesh globe = make_globe(40, kRadius);
  const ContactSide side = globe.make_side(kModulus, 1.0, Matrix3::Identity());
  const SurfaceParts cover = cover_mesh(
      std::get<std::shared_ptr<const MeshSurface>>(side.shape.kind)->surface());
  EXPECT_LE(cover.bodies.size(), kMostSurfaceParts);
  EXPECT_LT(cover.error, 5e-3 * kRadius);
  double facets = 0.0;
  for (const auto& face : globe.faces) {
    const auto& corners = globe.corners;
    facets += corners[index(face[0])].dot(
                  corners[index(face[1])].cross(corners[index(face[2])])) /
              6.0;
  }
  EXPECT_GE(find_volume(cover), facets);
  EXPECT_NEAR(find_volume(cover) / facets, 1.0, 5e-3);
  for (const PlacedBody& body : cover.bodies) {
    EXPECT_TRUE(PairPotential::suits(body.kind, make_body(Cylinder{0.1, 0.1})));
  }
}

TEST(MeshCover, OfABoxIsTheBox) {
  const flexbody::ContactSurface bar =
      make_mesh_surface({{0, 0}, {1, 0}, {2, 0}}, 0.02, 0.01);
  const SurfaceParts cover = cover_mesh(bar);
  ASSERT_EQ(cover.bodies.size(), 1U);
  EXPECT_LT(cover.error, 1e-12);
  EXPECT_NEAR(find_volume(cover), 0.06 * 0.02 * 0.01, 1e-15);
}

}  // namespace
}  // namespace limber::contact::surface_parts_test
