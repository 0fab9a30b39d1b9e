// SPDX-License-Identifier: BSD-3-Clause
// Small motion of linked groups beside strangers that are fast, heavily loaded
// or spinning.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "limber/dynamics/analysis/natural_frequencies.hpp"
#include "limber/dynamics/system/linked_groups.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/joint_kind.hpp"

namespace limber::dynamics::group_motion_test {
namespace {

joints::Bushing make_bushing(const Vector3& translation,
                             const Vector3& rotation, double damping = 0.0) {
  joints::Bushing::Parameters p;
  p.translational_stiffness = translation.asDiagonal();
  p.rotational_stiffness = rotation.asDiagonal();
  p.translational_damping = damping * Matrix3::Identity();
  return joints::Bushing(p);
}

// A body of 1 g on springs of 1e15 N/m, which oscillates at 1e9 rad/s.
void add_fast_stranger(SystemBuilder& builder) {
  const BodyIndex body =
      builder.add_rigid_body("stranger", {1e-3, 1e-3 * Matrix3::Identity()});
  builder.add_coupler(
      "hard", make_bushing(Vector3::Constant(1e15), Vector3::Constant(1e15)),
      builder.attach_world("there", {}),
      builder.attach_frame("of_stranger", body, {}));
}

// Of angular frequencies [rad/s].
bool has_mode(const NaturalModes& found, double omega, double tolerance) {
  for (const NaturalMode& m : found.modes) {
    if (std::abs(std::abs(m.value) - omega) <= tolerance * omega) return true;
  }
  return false;
}

long count_free_modes(const NaturalModes& modes) {
  return std::count_if(modes.modes.begin(), modes.modes.end(),
                       [](const NaturalMode& m) { return m.is_free(); });
}

// 1e-12 of the stranger's frequency counted as none.
TEST(MotionGroups, HaveSlowModesBesideAFastStranger) {
  constexpr double kSlow = 1e-3;
  SystemBuilder builder;
  const BodyIndex block =
      builder.add_rigid_body("block", {4.0, 4.0 * Matrix3::Identity()});
  const double k = 4.0 * kSlow * kSlow;
  builder.add_coupler(
      "soft", make_bushing(Vector3::Constant(k), Vector3::Constant(k), 1e-5),
      builder.attach_world("ground", {}),
      builder.attach_frame("hub", block, {}));
  add_fast_stranger(builder);
  const SystemModel model = builder.build();
  const NaturalModes found = find_natural_modes(model, make_state(model));
  EXPECT_EQ(count_free_modes(found), 0);
  ASSERT_EQ(found.modes.size(), 12U);
  for (int i = 0; i < 6; ++i) {
    const NaturalMode& m = found.modes[static_cast<std::size_t>(i)];
    EXPECT_NEAR(std::abs(m.value), kSlow, 1e-9 * kSlow);
  }
}

// What gravity resists was round-off of what a stranger's load resists.
TEST(MotionGroups, SwingSlowlyBesideAStrangerUnderAHugeLoad) {
  for (const double load : {0.0, 1e9}) {
    SystemBuilder builder;
    builder.set_gravity({0, 0, -10.0});
    const BodyIndex bob =
        builder.add_rigid_body("bob", {2.0, 0.3 * Matrix3::Identity()});
    builder.add_coupler(
        "hinge",
        joints::make_joint(
            joints::JointKind::revolute, Vector3::UnitY(), Vector3::UnitX(),
            {.translational_stiffness = 1e8, .rotational_stiffness = 1e8}),
        builder.attach_world("pin", {}),
        builder.attach_frame("eye", bob, {Matrix3::Identity(), {0, 0, 0.6}}));
    const BodyIndex other =
        builder.add_rigid_body("stranger", {1e-4, 1e-4 * Matrix3::Identity()});
    builder.add_load(
        "push",
        builder.attach_frame("tip", other, {Matrix3::Identity(), {1, 0, 0}}),
        Vector3(load, 0, 0), Vector3::Zero(), LoadFrame::world, TimeFunction{});
    const SystemModel model = builder.build();
    SystemState state = make_state(model);
    state.bodies[0].p_WB = Vector3(0, 0, -0.6 - 20.0 / 1e8);
    const double w = std::sqrt(2.0 * 10.0 * 0.6 / (0.3 + 2.0 * 0.36));
    const NaturalModes found = find_natural_modes(model, state);
    EXPECT_TRUE(has_mode(found, w, 1e-4)) << load;
  }
}

// A force of 200 N that follows the body and bends no spring: the triangle
// (k, -F; 0, k') has the eigenvalues k and k'. Beside a stranger its lack of
// symmetry was round-off.
TEST(MotionGroups, UnderAFollowerLoadAreNotSymmetricBesideAFastStranger) {
  for (const bool has_stranger : {false, true}) {
    SystemBuilder builder;
    const BodyIndex block =
        builder.add_rigid_body("block", {1.0, Matrix3::Identity()});
    builder.add_coupler(
        "hold", make_bushing({100.0, 200.0, 300.0}, {250.0, 150.0, 400.0}),
        builder.attach_world("ground", {}),
        builder.attach_frame("hub", block, {}));
    builder.add_load("thrust", builder.attach_frame("nozzle", block, {}),
                     Vector3(0, 0, 200.0), Vector3::Zero(), LoadFrame::body,
                     TimeFunction{});
    if (has_stranger) add_fast_stranger(builder);
    const SystemModel model = builder.build();
    const NaturalModes found = find_natural_modes(model, make_state(model));
    for (const double square : {100.0, 150.0, 200.0, 250.0}) {
      EXPECT_TRUE(has_mode(found, std::sqrt(square), 1e-9))
          << square << ' ' << has_stranger;
    }
  }
}

void add_rotor(SystemBuilder& builder, const std::string& name) {
  const Matrix3 J = Vector3(0.1, 0.1, 0.15).asDiagonal();
  const BodyIndex shaft = builder.add_rigid_body(name, {5.0, J});
  const BodyIndex mass = builder.add_rigid_body(name + ".mass", {2.0, J});
  builder.add_coupler(
      name + ".bearing",
      joints::make_joint(
          joints::JointKind::revolute, Vector3::UnitZ(), Vector3::UnitX(),
          {.translational_stiffness = 1e10, .rotational_stiffness = 1e10}),
      builder.attach_world(name + ".ground", {}),
      builder.attach_frame(name + ".hub", shaft, {}));
  builder.add_coupler(name + ".shaft",
                      make_bushing({2e4, 8e4, 1e10}, {1e10, 1e10, 1e10}),
                      builder.attach_frame(name + ".seat", shaft, {}),
                      builder.attach_frame(name + ".eye", mass, {}));
}

// In axes that turn (k_1/m - w^2 - s)(k_2/m - w^2 - s) = 4 w^2 s, s the square
// of a frequency. The slower rotor was judged in the other's axes.
TEST(MotionGroups, TurnInTheirOwnAxes) {
  SystemBuilder builder;
  add_rotor(builder, "slow");
  add_rotor(builder, "fast");
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  const std::vector<double> spins{50.0, 50.0, 300.0, 300.0};
  for (std::size_t b = 0; b < 4; ++b) {
    state.bodies[b].w_WB_B = Vector3(0, 0, spins[b]);
  }
  const NaturalModes found = find_natural_modes(model, state);
  EXPECT_LT(found.change, 1e-6);
  EXPECT_FALSE(found.imbalance.matters);
  for (const double w : {50.0, 300.0}) {
    const double a = 2e4 / 2.0 - w * w;
    const double b = 8e4 / 2.0 - w * w;
    const double half = 0.5 * (a + b + 4.0 * w * w);
    const double root = std::sqrt(half * half - a * b);
    for (const double s : {half + root, half - root}) {
      EXPECT_TRUE(has_mode(found, std::sqrt(std::abs(s)), 1e-4)) << w;
    }
  }
}

// Of two rotors.
TEST(LinkedGroups, AreJoinedByGears) {
  SystemBuilder builder;
  add_rotor(builder, "one");
  add_rotor(builder, "two");
  EXPECT_EQ(find_linked_groups(builder.build()).size(), 2U);
  const SystemModel model = builder.build();
  builder.add_joint_sum(
      "gear",
      JointSum{.terms = {{model.find_coupler("one.bearing"), 0, 1.0},
                         {model.find_coupler("two.bearing"), 0, 2.0}}},
      {joints::ScalarSpring(
          {.curve = joints::SpringCurve({.stiffness = 1e3, .extensions = {}}),
           .damping = 0.0})});
  EXPECT_EQ(find_linked_groups(builder.build()).size(), 1U);
  EXPECT_TRUE(find_free_groups(builder.build()).empty());
}

// A free top travels while a stranger is held to the world.
TEST(MotionGroups, DriftWhileAStrangerIsHeld) {
  for (const bool has_stranger : {false, true}) {
    SystemBuilder builder;
    builder.add_rigid_body("top",
                           {3.0, Matrix3(Vector3(1, 2, 2.5).asDiagonal())});
    if (has_stranger) add_fast_stranger(builder);
    const SystemModel model = builder.build();
    SystemState state = make_state(model);
    state.bodies[0].v_WB_W = Vector3(1, 2, 3);
    state.bodies[0].w_WB_B = Vector3(7, 0, 0);
    const NaturalModes found = find_natural_modes(model, state);
    EXPECT_FALSE(found.imbalance.matters) << has_stranger;
    EXPECT_EQ(count_free_modes(found), 4) << has_stranger;
    EXPECT_TRUE(has_mode(found, 7.0 * std::sqrt(1.5 / 5.0), 1e-9));
  }
}

// 1 N is missing, while a stranger's spring holds 1e8 N in balance.
TEST(MotionGroups, AreOutOfBalanceBesideAStrangerUnderAHugeLoad) {
  constexpr double kHuge = 1e8;
  SystemBuilder builder;
  const BodyIndex block =
      builder.add_rigid_body("block", {1.0, Matrix3::Identity()});
  const BodyIndex other =
      builder.add_rigid_body("stranger", {1.0, Matrix3::Identity()});
  for (const auto& [body, name, force] :
       {std::tuple{block, "soft", 1.0}, std::tuple{other, "hard", kHuge}}) {
    builder.add_coupler(
        name, make_bushing(Vector3::Constant(kHuge), Vector3::Constant(kHuge)),
        builder.attach_world(std::string("ground.") + name, {}),
        builder.attach_frame(std::string("hub.") + name, body, {}));
    builder.add_load(
        std::string("load.") + name,
        builder.attach_frame(std::string("middle.") + name, body, {}),
        Vector3(force, 0, 0), Vector3::Zero(), LoadFrame::world,
        TimeFunction{});
  }
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[1].p_WB = Vector3(1.0, 0, 0);
  const Imbalance left = find_natural_modes(model, state).imbalance;
  EXPECT_TRUE(left.matters);
  EXPECT_EQ(left.force_body, "block");
  EXPECT_NEAR(left.force, 1.0, 1e-6);
}

}  // namespace
}  // namespace limber::dynamics::group_motion_test
