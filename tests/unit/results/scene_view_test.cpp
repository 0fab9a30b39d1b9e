// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/scene_view.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "small_run.hpp"

namespace limber::results::scene_view_test {
namespace {

TEST(Magnification, IsOneOfWhatCanBeSeenAndOfRoundOff) {
  EXPECT_EQ(find_magnification(0.03, 1.0), 1.0);
  EXPECT_EQ(find_magnification(1e-11, 1.0), 1.0);
  EXPECT_EQ(find_magnification(0.0, 1.0), 1.0);
}

TEST(Magnification, MakesSmallDeformationsVisible) {
  for (double u = 1e-8; u < 0.02; u *= 1.37) {
    const double factor = find_magnification(u, 1.0);
    EXPECT_GE(factor * u, 0.6 * 0.0399) << u;
    EXPECT_LE(factor * u, 0.0601) << u;
    const double digit =
        factor / std::pow(10.0, std::floor(std::log10(factor) + 1e-9));
    EXPECT_LT(std::min({std::abs(digit - 1.0), std::abs(digit - 2.0),
                        std::abs(digit - 5.0)}),
              1e-9);
  }
}

TEST(View, IsSeenAlongTheDirectionThatTurnsTowardsTheEye) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  for (const double x : {20.0, 60.0, 75.0}) {
    for (const double z : {0.0, 30.0, 200.0, 340.0}) {
      const Vector3 eye =
          Eigen::AngleAxisd(z * kDegree, Vector3::UnitZ()) *
          (Eigen::AngleAxisd(x * kDegree, Vector3::UnitX()) * Vector3::UnitZ());
      EXPECT_LT((find_eye({x, z}) - eye).norm(), 1e-12);
    }
  }
}

/// Points of a bar along `along`, at rest and moved to its side.
std::vector<Matrix3X> make_shots(const Vector3& along, const Vector3& moved) {
  Matrix3X bar(3, 11);
  for (int i = 0; i < 11; ++i) bar.col(i) = 0.1 * i * along;
  Matrix3X later = bar;
  for (int i = 0; i < 11; ++i) later.col(i) += 0.01 * i * i * moved;
  return {bar, later};
}

TEST(View, IsFromTheSideOfTheMotion) {
  const Vector3 axes[] = {Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ(),
                          Vector3(1.0, 2.0, 0.5).normalized()};
  for (const Vector3& along : axes) {
    for (const Vector3& moved : axes) {
      const Vector3 side = along.cross(moved);
      if (side.norm() < 0.1) continue;
      const Vector3 eye = find_eye(find_view(make_shots(along, 0.1 * moved)));
      EXPECT_GT(std::abs(eye.dot(side.normalized())),
                std::cos(35.0 * std::numbers::pi / 180.0));
      EXPECT_GT(eye.z(), 0.2);
    }
  }
}

TEST(View, OfNothingIsAnOrdinaryOne) {
  EXPECT_EQ(find_view({}).rot_x, ViewAngles{}.rot_x);
  EXPECT_EQ(find_view({Matrix3X(3, 0)}).rot_z, ViewAngles{}.rot_z);
  const ViewAngles point = find_view({Matrix3X::Zero(3, 1)});
  EXPECT_TRUE(std::isfinite(point.rot_x) && std::isfinite(point.rot_z));
}

TEST(LargestDeformation, IsThatOfTheOutputs) {
  test::SmallRun run = test::make_small_run();
  ASSERT_GT(run.history.states.size(), 2U);
  test::change_states(run.history, [](auto& state) { state.eta.setZero(); });
  EXPECT_EQ(find_largest_deformation(run.model, run.history).deformation, 0.0);
  const double second = run.history.times[1];
  test::change_states(run.history, [&](auto& state) {
    if (state.t == second) state.eta[0] = 0.5;
  });
  const DeformationPeak peak = find_largest_deformation(run.model, run.history);
  EXPECT_EQ(peak.output, 1U);
  const auto& Phi = run.model.bodies[0].reduced->rows.Phi_B;
  EXPECT_NEAR(
      peak.deformation,
      0.5 * Phi.col(0).reshaped(3, Phi.rows() / 3).colwise().norm().maxCoeff(),
      1e-12);
}

}  // namespace
}  // namespace limber::results::scene_view_test
