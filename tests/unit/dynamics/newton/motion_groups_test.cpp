// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/motion_groups.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/system/unknowns.hpp"
#include "limber/joints/joint_kind.hpp"
#include "support/paired_bodies.hpp"

namespace limber::dynamics::motion_groups_test {
namespace {

BodyIndex add_body(SystemBuilder& builder, const std::string& name,
                   double mass) {
  return builder.add_rigid_body(name, {mass, Matrix3::Identity()});
}

AttachmentIndex frame_of(SystemBuilder& builder, BodyIndex body) {
  return builder.attach_frame("frame", body, {});
}

CouplerIndex join(SystemBuilder& builder, const std::string& name,
                  AttachmentIndex a, AttachmentIndex b) {
  return builder.add_coupler(
      name,
      joints::make_joint(
          joints::JointKind::revolute, Vector3::UnitZ(), Vector3::UnitX(),
          {.translational_stiffness = 1e6, .rotational_stiffness = 1e6}),
      a, b);
}

std::vector<double> measure(const SystemModel& model, const SystemState& state,
                            const std::vector<Vector3>& translations) {
  SystemTerms terms = make_terms(model);
  calc_terms(model, state, Side::right, terms);
  VectorX motion = make_unknowns(model);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    translation_rows(model.bodies[b], motion) = translations[b];
  }
  MotionGroups groups(model);
  std::vector<double> lengths(groups.count());
  groups.measure_motion(model, state, terms, motion, lengths);
  return lengths;
}

TEST(MotionGroups, AreBodiesThatCouplersConnectButNotTheWorld) {
  SystemBuilder builder;
  const auto a = frame_of(builder, add_body(builder, "a", 1.0));
  const auto b = frame_of(builder, add_body(builder, "b", 1.0));
  const auto c = frame_of(builder, add_body(builder, "c", 1.0));
  add_body(builder, "d", 1.0);
  const auto world = builder.attach_world("wall", {});
  join(builder, "ac", a, c);
  join(builder, "a", world, a);
  join(builder, "b", world, b);
  const MotionGroups groups(builder.build());
  EXPECT_EQ(groups.count(), 3U);
  EXPECT_EQ(groups.of(0), groups.of(2));
  EXPECT_NE(groups.of(0), groups.of(1));
  EXPECT_NE(groups.of(3), groups.of(0));
  EXPECT_NE(groups.of(3), groups.of(1));
}

// Two joints of the world that a gear connects.
TEST(MotionGroups, AreBodiesThatGearsConnect) {
  SystemBuilder builder;
  const auto a = frame_of(builder, add_body(builder, "a", 1.0));
  const auto b = frame_of(builder, add_body(builder, "b", 1.0));
  const auto world = builder.attach_world("wall", {});
  const auto first = join(builder, "a", world, a);
  const auto second = join(builder, "b", world, b);
  EXPECT_EQ(MotionGroups(builder.build()).count(), 2U);
  builder.add_joint_sum("gear", {{{first, 0, 1.0}, {second, 0, -2.0}}, 0.0},
                        {});
  EXPECT_EQ(MotionGroups(builder.build()).count(), 1U);
}

// 1 kg and 3 kg, 4 m apart in a step: 3 m and 1 m from their common motion.
TEST(MotionGroups, MeasureFreeMotionRelativeToTheirMassCentre) {
  SystemBuilder builder;
  const auto a = frame_of(builder, add_body(builder, "a", 1.0));
  const auto b = frame_of(builder, add_body(builder, "b", 3.0));
  join(builder, "ab", a, b);
  const SystemModel model = builder.build();
  const SystemState state = make_state(model);
  const Vector3 common(7.5, -3.0, 2.0);
  const std::vector<double> lengths =
      measure(model, state, {common + Vector3(4.0, 0.0, 0.0), common});
  ASSERT_EQ(lengths.size(), 1U);
  EXPECT_NEAR(lengths[0], 3.0, 1e-14);
}

TEST(MotionGroups, MeasureTheWholeMotionOfWhatTheWorldHolds) {
  SystemBuilder builder;
  const auto a = frame_of(builder, add_body(builder, "a", 1.0));
  join(builder, "a", builder.attach_world("wall", {}), a);
  add_body(builder, "other", 1e6);
  const SystemModel model = builder.build();
  const std::vector<double> lengths = measure(
      model, make_state(model), {Vector3(0.0, 2e-3, 0.0), {7.5, 0.0, 0.0}});
  ASSERT_EQ(lengths.size(), 2U);
  EXPECT_DOUBLE_EQ(lengths[0], 2e-3);
  EXPECT_EQ(lengths[1], 0.0);
}

// Spheres of 1 m, and a half space z <= 0.
class Spheres : public ::testing::Test {
 protected:
  static std::vector<double> measure_at(double x, double z) {
    SystemBuilder builder;
    const auto a = add_body(builder, "a", 1.0);
    const auto b = add_body(builder, "b", 1.0);
    using limber::testing::SphereContact;
    builder.add_pair("ab", a, b,
                     std::make_shared<SphereContact>(1e3, 1.0, 1.0));
    builder.add_pair("floor", kWorld, a,
                     std::make_shared<SphereContact>(1e3, 0.0, 1.0));
    const SystemModel model = builder.build();
    SystemState state = make_state(model);
    state.bodies[0].p_WB = {0.0, 0.0, z};
    state.bodies[1].p_WB = {x, 0.0, 10.0};
    return measure(model, state,
                   {Vector3(1.0, 0.0, 0.0), Vector3(4.0, 0.0, 0.0)});
  }
};

TEST_F(Spheres, ThatTouchHaveOneMotion) {
  EXPECT_EQ(measure_at(2.5, 10.0), (std::vector{0.0, 0.0}));
  EXPECT_EQ(measure_at(1.5, 10.0), (std::vector{1.5, 1.5}));
}

TEST_F(Spheres, ThatTouchTheWorldMoveRelativeToIt) {
  EXPECT_EQ(measure_at(2.5, 0.5), (std::vector{1.0, 0.0}));
}

}  // namespace
}  // namespace limber::dynamics::motion_groups_test
