// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/relative_energy.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/system/system_builder.hpp"

namespace limber::dynamics::relative_energy_test {
namespace {

using ::testing::ElementsAre;

const BodyIndex kA(0);
const BodyIndex kB(1);

// Two bodies, joined, and a third on its own.
struct Scene {
  SystemModel model;
  SystemState state;
};

Scene make_scene() {
  SystemBuilder builder;
  Matrix3 inertia = Vector3(0.2, 0.3, 0.4).asDiagonal();
  const auto a = builder.add_rigid_body("a", {3.0, inertia});
  const auto b = builder.add_rigid_body("b", {1.0, inertia});
  builder.add_rigid_body("c", {1e6, inertia});
  builder.add_coupler("ab", joints::Bushing({}),
                      builder.attach_frame("at_a", a, {}),
                      builder.attach_frame("at_b", b, {}));
  builder.add_coupler("held", joints::Bushing({}),
                      builder.attach_world("world", {}),
                      builder.attach_frame("also_at_b", b, {}));
  Scene scene{builder.build(), {}};
  scene.state = make_state(scene.model);
  scene.state.bodies[0].p_WB = {1.0, -2.0, 0.5};
  scene.state.bodies[1].p_WB = {0.0, 1.0, 2.0};
  scene.state.bodies[1].v_WB_W = {4.0, 0.0, 0.0};
  scene.state.bodies[2].v_WB_W = {0.0, 7e3, 0.0};
  return scene;
}

// Adds a rigid motion of everything.
void add_motion(const Vector3& v, const Vector3& w, SystemState& state) {
  for (BodyState& body : state.bodies) {
    body.v_WB_W += v + w.cross(body.p_WB);
    body.w_WB_B += body.quat_WB.conjugate() * w;
  }
}

TEST(RelativeEnergy, JoinedBodiesAreThoseOfBothFrames) {
  const Scene scene = make_scene();
  EXPECT_THAT(find_joined_bodies(scene.model, scene.model.couplers[0]),
              ElementsAre(kA, kB));
  EXPECT_THAT(find_joined_bodies(scene.model, scene.model.couplers[1]),
              ElementsAre(kWorld, kB));
}

TEST(RelativeEnergy, IsThatOfTheLighterBodySeenFromTheOther) {
  const Scene scene = make_scene();
  EXPECT_DOUBLE_EQ(find_relative_kinetic(scene.model, scene.state, {kA, kB}),
                   0.5 * 1.0 * 16.0);
  EXPECT_DOUBLE_EQ(find_relative_kinetic(scene.model, scene.state, {kB, kA}),
                   0.5 * 1.0 * 16.0);
}

TEST(RelativeEnergy, DoesNotDependOnCommonMotion) {
  Scene scene = make_scene();
  scene.state.bodies[0].w_WB_B = {1.0, 2.0, -1.0};
  scene.state.bodies[1].quat_WB =
      Quaternion(exp_rotation(Vector3(0.3, -1.0, 0.4)));
  const double still =
      find_relative_kinetic(scene.model, scene.state, {kA, kB});
  EXPECT_GT(still, 8.0);
  add_motion({10.0, -70.0, 30.0}, {3.0, 1.0, -5.0}, scene.state);
  EXPECT_NEAR(find_relative_kinetic(scene.model, scene.state, {kA, kB}), still,
              1e-12 * still);
}

TEST(RelativeEnergy, IsAbsoluteForABodyThatTheWorldHolds) {
  Scene scene = make_scene();
  scene.state.bodies[1].w_WB_B = {0.0, 0.0, 5.0};
  EXPECT_DOUBLE_EQ(
      find_relative_kinetic(scene.model, scene.state, {kWorld, kB}),
      0.5 * 16.0 + 0.5 * 0.4 * 25.0);
}

TEST(RelativeEnergy, OfRigidMotionIsZero) {
  Scene scene = make_scene();
  scene.state = make_state(scene.model);
  scene.state.bodies[1].p_WB = {0.0, 1.0, 2.0};
  add_motion({1.0, 2.0, 3.0}, {0.5, -4.0, 2.0}, scene.state);
  EXPECT_NEAR(find_relative_kinetic(scene.model, scene.state, {kA, kB}), 0.0,
              1e-28);
}

}  // namespace
}  // namespace limber::dynamics::relative_energy_test
