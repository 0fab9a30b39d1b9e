// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/ball_on_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "limber/contact/law/hertz_law.hpp"
#include "limber/contact/law/materials.hpp"
#include "unit/contact/shapes/surfaces.hpp"

/// A ball on a surface that modes deform.
namespace limber::contact::ball_on_surface_test {
namespace {

constexpr double kModulus = 1e9;
constexpr double kResidual = 3e-8;
constexpr double kSize = 0.8;    // of the flexible body
constexpr double kRadius = 0.3;  // of the ball

ContactSide make_mesh_surface(const flexbody::ContactSurface& surface) {
  return {Shape{std::make_shared<const MeshSurface>(surface), {}}, {}, 1.0};
}

flexbody::ContactSurface make_surface() {
  auto surface = test::make_ball_surface(kSize, 2, true);
  test::set_modes(surface, test::make_fields());
  surface.residual.setConstant(kResidual);
  return surface;
}

ContactSide make_ball(double radius) {
  return {Shape{Sphere{radius}, {}}, {}, 1.0};
}

joints::PairBody make_body(const VectorX& eta) {
  return {.modes = static_cast<int>(eta.size()), .eta = eta.data()};
}

const Patch* find_patch(const PatchTouches& touches) {
  return touches.is_empty() ? nullptr : &touches.begin()->patch;
}

VectorX draw_modes(std::mt19937& random) {
  std::uniform_real_distribution<double> within(-1.0, 1.0);
  return VectorX::NullaryExpr(4, [&] { return within(random); });
}

// By the displacements of both points, with names either way.
TEST(BallOnSurface, ActsOnMotionsAndModesAsItsEnergyFalls) {
  std::mt19937 random(1);
  const ContactSide mesh_surface = make_mesh_surface(make_surface());
  const ContactSide ball = make_ball(kRadius);
  for (const bool is_surface_A : {true, false}) {
    const BallOnSurface pair =
        is_surface_A ? BallOnSurface(mesh_surface, ball, kModulus, {})
                     : BallOnSurface(ball, mesh_surface, kModulus, {});
    for (int trial = 0; trial < 10; ++trial) {
      const VectorX eta = 0.01 * draw_modes(random);
      const VectorX d_eta = draw_modes(random);
      const Vector3 d_p = test::draw_point(random, 1.0);
      joints::PairBody round;
      round.p_WB =
          (kSize + kRadius - 0.02) * test::draw_point(random, 1.0).normalized();
      const auto touch = [&](double by) {
        const VectorX moved = eta + by * d_eta;
        joints::PairBody other = round;
        other.p_WB += by * d_p;
        const joints::PairBody body = make_body(moved);
        const joints::PairBodies bodies = is_surface_A
                                              ? joints::PairBodies{body, other}
                                              : joints::PairBodies{other, body};
        const PatchTouches found = pair.find_patches(bodies, true);
        EXPECT_FALSE(found.is_empty()) << trial;
        return found.is_empty() ? PatchTouch{} : *found.begin();
      };
      const PatchTouch at = touch(0.0);
      constexpr double kStep = 1e-5;
      const double slope =
          (touch(kStep).patch.energy - touch(-kStep).patch.energy) /
          (2.0 * kStep);
      joints::PairPoint point;
      (is_surface_A ? point.on_A : point.on_B).Phi_B = Matrix3X::Zero(3, 4);
      const joints::PairBody body = make_body(eta);
      const joints::PairBodies bodies = is_surface_A
                                            ? joints::PairBodies{body, round}
                                            : joints::PairBodies{round, body};
      pair.set_places(bodies, at, at.patch.centre_W, point);
      const Vector3 force_on_B = -at.patch.gradient_W.head<3>();
      const Matrix3X& Phi = (is_surface_A ? point.on_A : point.on_B).Phi_B;
      const Vector3 way = (is_surface_A ? 1.0 : -1.0) * (d_p - Phi * d_eta);
      EXPECT_NEAR(force_on_B.dot(way), -slope, 2e-3 * std::abs(slope)) << trial;
      EXPECT_LT((find_position(body, is_surface_A ? point.on_A : point.on_B) -
                 at.patch.centre_W)
                    .norm(),
                1e-13);
    }
  }
}

TEST(BallOnSurface, PressesAsHertzInSeriesWithTheResidual) {
  auto surface = make_surface();
  surface.Phi_B.resize(surface.Phi_B.rows(), 0);
  const BallOnSurface pair(make_mesh_surface(surface), make_ball(kRadius),
                           kModulus, {});
  joints::PairBody ball;
  constexpr double kDepth = 1e-3;
  ball.p_WB = Vector3(0.0, 0.0, kSize + kRadius - kDepth);
  const PatchTouches touches = pair.find_patches({{}, ball}, true);
  const Patch* patch = find_patch(touches);
  ASSERT_NE(patch, nullptr);
  const double R_e = 1.0 / (1.0 / kRadius + 1.0 / kSize);
  const auto expected =
      HertzLaw({find_hertz_stiffness(kModulus, R_e), kResidual})
          .evaluate(kDepth);
  EXPECT_NEAR(patch->load() / expected.force, 1.0, 1e-2);  // of its faces
  EXPECT_NEAR(patch->energy / expected.energy(), 1.0, 1e-2);
}

// In a hollow of its own curvature R_e would be infinite.
TEST(BallOnSurface, IsNoFlatterThanItsSurfacesPatchesInAHollow) {
  const auto hollow = test::make_sheet_surface(
      0.5, 4, true, [](double x, double y) { return x * x + y * y; });
  const ContactSide mesh_surface = make_mesh_surface(hollow);
  const BallOnSurface pair(mesh_surface, make_ball(0.5), kModulus, {});
  joints::PairBody ball;
  ball.p_WB = Vector3(0.0, 0.0, 0.5 - 1e-4);
  const PatchTouches touches = pair.find_patches({{}, ball}, true);
  const Patch* patch = find_patch(touches);
  ASSERT_NE(patch, nullptr);
  EXPECT_TRUE(std::isfinite(patch->load()));
  EXPECT_GT(patch->load(), 0.0);
}

TEST(BallOnSurface, IsAsFarAsItsNearestPlace) {
  const BallOnSurface pair(make_mesh_surface(make_surface()),
                           make_ball(kRadius), kModulus, {});
  const VectorX eta = VectorX::Zero(4);
  const joints::PairBody body = make_body(eta);
  joints::PairBody ball;
  ball.p_WB = Vector3(0.3, -0.5, 1.2);
  const double exact = ball.p_WB.norm() - kSize - kRadius;
  EXPECT_NEAR(pair.find_distance({body, ball}), exact, 2e-3);
  const PatchFinder::Nearest nearest = pair.find_nearest({body, ball});
  EXPECT_NEAR(nearest.gap.distance, exact, 2e-3);
  EXPECT_LT((nearest.gap.normal_W - ball.p_WB.normalized()).norm(), 1e-2);
  EXPECT_NEAR((nearest.gap.on_B - nearest.gap.on_A).norm(),
              nearest.gap.distance, 1e-12);
  ball.p_WB *= 20.0;
  EXPECT_LE(pair.find_distance({body, ball}),
            ball.p_WB.norm() - kSize - kRadius + 1e-9);
  EXPECT_GT(pair.find_distance({body, ball}), 10.0);
}

}  // namespace
}  // namespace limber::contact::ball_on_surface_test
