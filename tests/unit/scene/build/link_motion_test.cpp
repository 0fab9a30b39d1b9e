// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/link_motion.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "limber/common/rotation.hpp"
#include "unit/scene/temporary_file.hpp"

namespace limber::scene::link_motion_test {
namespace {

constexpr double kRoundOff = 1e-13;

/// a --(revolute about z at x = 1)-- b --(prismatic along x)-- c
Robot make_robot() {
  Robot robot;
  robot.links = {{"a", {}, {}}, {"b", {}, {}}, {"c", {}, {}}};
  Joint turn;
  turn.name = "turn";
  turn.kind = joints::JointKind::revolute;
  turn.child = 1;
  turn.X_PJ.p = Vector3::UnitX();
  turn.axis_J = Vector3::UnitZ();
  Joint slide;
  slide.name = "slide";
  slide.kind = joints::JointKind::prismatic;
  slide.parent = 1;
  slide.child = 2;
  slide.axis_J = Vector3::UnitX();
  robot.joints = {turn, slide};
  return robot;
}

/// The scenario a time `dt` after the start, rates held.
Scenario make_scenario(double dt) {
  Scenario scenario;
  scenario.joints["turn"] = {{0.3 + 0.7 * dt}, {0.7}};
  scenario.joints["slide"] = {{2.0 - 0.4 * dt}, {-0.4}};
  const Vector3 w(0.1, -0.2, 0.5);
  scenario.base.velocity = Vector3(1, 2, 3);
  scenario.base.angular_velocity = w;
  scenario.base.position = dt * scenario.base.velocity;
  const Matrix3 R = exp_rotation(dt * w);
  scenario.base.orientation_rpy =
      Vector3(std::atan2(R(2, 1), R(2, 2)), -std::asin(R(2, 0)),
              std::atan2(R(1, 0), R(0, 0)));
  return scenario;
}

TEST(LinkMotion, VelocitiesAreRatesOfThePoses) {
  const Robot robot = make_robot();
  constexpr double h = 1e-5;
  // Central differences: truncation h^2, round-off 1e-16 / h.
  constexpr double kTolerance = 1e-9;
  const auto now = find_link_motions(robot, make_scenario(0.0));
  const auto before = find_link_motions(robot, make_scenario(-h));
  const auto after = find_link_motions(robot, make_scenario(h));
  for (std::size_t i = 0; i < now.size(); ++i) {
    const Vector3 v = (after[i].X_WL.p - before[i].X_WL.p) / (2 * h);
    const Matrix3 turn = after[i].X_WL.R * before[i].X_WL.R.transpose();
    const Vector3 w = log_rotation(turn) / (2 * h);
    EXPECT_LT((now[i].v_WL_W - v).norm(), kTolerance);
    EXPECT_LT((now[i].w_WL_W - w).norm(), kTolerance);
  }
  EXPECT_GT(now[2].v_WL_W.norm(), 1.0);
}

TEST(LinkMotion, PlacesTheChildAtTheJoint) {
  const auto motions = find_link_motions(make_robot(), make_scenario(0.0));
  const Vector3 expected(1 + 2 * std::cos(0.3), 2 * std::sin(0.3), 0);
  EXPECT_LT((motions[2].X_WL.p - expected).norm(), kRoundOff);
}

TEST(LinkMotion, RefusesForeignJointsAndWrongCounts) {
  Scenario scenario;
  scenario.joints["trun"] = {{1.0}, {}};
  scenario.joints["slide"] = {{1.0, 2.0}, {}};
  const std::string text = test::input_error(
      [&] { (void)find_link_motions(make_robot(), scenario); });
  EXPECT_THAT(text, ::testing::HasSubstr("did you mean 'turn'"));
  EXPECT_THAT(text, ::testing::HasSubstr("has 2 numbers"));
}

}  // namespace
}  // namespace limber::scene::link_motion_test
