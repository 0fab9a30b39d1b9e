// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/motion_scale.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/system/unknowns.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics::motion_scale_test {
namespace {

// A small rigid body, and a cloud of masses with two modes.
class MotionScaleTest : public ::testing::Test {
 protected:
  MotionScaleTest()
      : cloud_(testing::make_point_mass_body(20, 2, 4.0, 1.0, 50.0, 1)),
        model_(build(cloud_)),
        scale_(model_),
        a_(make_unknowns(model_)),
        b_(a_) {}

  static SystemModel build(const testing::PointMassBody& cloud) {
    SystemBuilder builder;
    builder.add_rigid_body("small", {1.0, 1e-4 * Matrix3::Identity()});
    builder.add_flexible_body("cloud", testing::share(cloud), Fidelity::coupled,
                              {});
    return builder.build();
  }
  [[nodiscard]] double farthest() const {
    return cloud_.reduced.rows.x_B.colwise().norm().maxCoeff();
  }
  // Largest displacement of a mass by a mode.
  [[nodiscard]] double size_of(int mode) const {
    return cloud_.reduced.rows.Phi_B.col(mode)
        .reshaped(3, cloud_.masses.size())
        .colwise()
        .norm()
        .maxCoeff();
  }

  static constexpr int kSmall = 0;
  static constexpr int kCloud = 1;
  [[nodiscard]] auto translation(int body, VectorX& x) const {
    return translation_rows(model_.bodies[static_cast<std::size_t>(body)], x);
  }
  [[nodiscard]] auto rotation(int body, VectorX& x) const {
    return rotation_rows(model_.bodies[static_cast<std::size_t>(body)], x);
  }
  [[nodiscard]] auto modes(VectorX& x) const {
    return mode_rows(model_.bodies[kCloud], x);
  }

  testing::PointMassBody cloud_;
  SystemModel model_;
  MotionScale scale_;
  VectorX a_, b_;
};

TEST_F(MotionScaleTest, TakesTheBodyWhosePointsMoveMost) {
  translation(kSmall, b_) = Vector3(0.3, 0.0, 0.0);
  translation(kCloud, b_) = Vector3(0.0, 0.0, 0.2);
  const auto largest = scale_.measure_change(a_, b_, 0.5, 0.0);
  EXPECT_EQ(largest.body, 0);
  EXPECT_NEAR(largest.displacement, 0.15, 1e-15);
  rotation(kCloud, b_) = Vector3(0.0, 1.0, 0.0);
  EXPECT_EQ(scale_.measure_change(a_, b_, 0.5, 0.0).body, 1);
}

TEST_F(MotionScaleTest, AddsSquaresOfTranslationRotationAndModes) {
  translation(kCloud, a_) = Vector3(0.1, 0.2, 0.3);
  translation(kCloud, b_) = Vector3(0.4, 0.2, -0.1);  // 0.5 apart
  rotation(kCloud, a_) = Vector3(0.0, 1.0, 0.0);
  rotation(kCloud, b_) = Vector3(0.0, 3.0, 0.0);
  modes(a_) << 0.7, -0.2;
  modes(b_) << 1.0, 0.3;
  const double expected =
      0.01 *
      std::sqrt(0.25 + std::pow(2.0 * farthest(), 2) +
                std::pow(0.3 * size_of(0), 2) + std::pow(0.5 * size_of(1), 2));
  EXPECT_NEAR(scale_.measure_change(a_, b_, 0.01, 0.0).displacement, expected,
              1e-14);
}

TEST_F(MotionScaleTest, TakesOfAModeWhatItsStiffnessLeaves) {
  modes(b_) << 1.0, 0.3;
  const VectorX& lambda = cloud_.reduced.lambda;
  const double filter = 3.0 / lambda[1];
  const double expected = std::hypot(size_of(0) / (1.0 + filter * lambda[0]),
                                     0.3 * size_of(1) / 4.0);
  EXPECT_NEAR(scale_.measure_change(a_, b_, 1.0, filter).displacement, expected,
              1e-14);
}

TEST_F(MotionScaleTest, MeasuresTheDistanceOfTwoStates) {
  SystemState x = make_state(model_);
  SystemState y = x;
  x.bodies[1].p_WB = Vector3(1.0, 2.0, 3.0);
  y.bodies[1].p_WB = Vector3(1.0, 2.3, 2.6);
  x.bodies[1].quat_WB = Quaternion(exp_rotation(Vector3(0.2, -0.4, 0.1)));
  y.bodies[1].quat_WB =
      x.bodies[1].quat_WB * Quaternion(exp_rotation(Vector3(0.0, 0.6, 0.0)));
  x.eta << 0.7, -0.2;
  y.eta << 0.4, -0.1;
  const double expected =
      std::sqrt(0.25 + std::pow(0.6 * farthest(), 2) +
                std::pow(0.3 * size_of(0), 2) + std::pow(0.1 * size_of(1), 2));
  const auto largest = scale_.measure_distance(x, y);
  EXPECT_EQ(largest.body, 1);
  EXPECT_NEAR(largest.displacement, expected, 1e-14);
  y.bodies[1].quat_WB.coeffs() *= -1.0;  // the same rotation
  EXPECT_NEAR(scale_.measure_distance(x, y).displacement, expected, 1e-14);
}

TEST_F(MotionScaleTest, TellsTheBodyThatIsNotANumber) {
  translation(kSmall, b_) = Vector3(5.0, 0.0, 0.0);
  modes(b_)[1] = std::nan("");
  const auto largest = scale_.measure_change(a_, b_, 1.0, 0.0);
  EXPECT_EQ(largest.body, 1);
  EXPECT_TRUE(std::isnan(largest.displacement));
}

TEST_F(MotionScaleTest, ReachIsTheFarthestPointOrTheRadiusOfGyration) {
  EXPECT_NEAR(find_reach(model_, BodyIndex(1)), farthest(), 1e-15);
  EXPECT_NEAR(find_reach(model_, BodyIndex(0)), std::sqrt(1.5e-4), 1e-15);
  SystemBuilder builder;
  const auto body = builder.add_rigid_body("b", {1.0, Matrix3::Identity()});
  builder.attach_frame("handle", body, {Matrix3::Identity(), {0.0, 3.0, 4.0}});
  EXPECT_NEAR(find_reach(builder.build(), BodyIndex(0)), 5.0, 1e-15);
}

}  // namespace
}  // namespace limber::dynamics::motion_scale_test
