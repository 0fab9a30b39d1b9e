// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reference/verification.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "limber/reference/scene_mechanism.hpp"
#include "unit/reference/scene_folder.hpp"

namespace limber::reference::verification_test {
namespace {

using test::make_coupler;
using test::make_joint;
using test::make_link;
using test::RigidScene;

constexpr double kRoundOff = 1e-13;
constexpr double kStiffness = 1e5;  // of the joints [N/m, N m/rad]

/// Every kind of joint, merged links, a spring, a bushing; free in space.
std::string make_zoo(double stiffness, double damping) {
  std::string text = "<robot name=\"zoo\">" + make_link("base", 8.0) +
                     "<link name=\"mount\"/>" + make_link("tool", 0.7) +
                     make_link("turning", 2.0) + make_link("sliding", 1.5) +
                     make_link("gliding", 1.0) + make_link("flying", 0.5);
  text += make_joint("weld", "fixed", "base", "mount");
  text += make_joint("weld_tool", "fixed", "turning", "tool");
  text += make_joint("turn", "continuous", "mount", "turning", "1 2 -1");
  text += make_joint("slide", "prismatic", "turning", "sliding", "0.3 1 0.2");
  text += make_joint("glide", "planar", "base", "gliding", "0.1 -0.2 1");
  text += make_joint("fly", "floating", "tool", "flying");
  for (const char* joint : {"turn", "slide", "glide"}) {
    text += make_coupler(joint, stiffness, damping, 0.1);
  }
  text += R"(
    <spring name="cord" from="tool" from_xyz="0.1 0 0" to="gliding"
            to_xyz="0 0.1 0" stiffness="200" damping="0.5" free_length="0.4"/>
    <bushing name="pad" from="flying" from_xyz="0.2 0 0" to="base"
             translational_stiffness="50 80 20" rotational_stiffness="3 1 2"
             translational_damping="0.3 0.1 0.2"
             rotational_damping="0.02 0.01 0.03"/></robot>)";
  return text;
}

std::string make_zoo_scenario(double duration, double step) {
  return "[time]\nduration = " + std::to_string(duration) +
         "\nstep = " + std::to_string(step) +
         R"(
output_interval = 0.01
integrator = "runge-kutta-4"
[gravity]
acceleration = [0.5, -1.0, -9.81]
[initial.base]
position = [0.3, -0.2, 1.0]
orientation_rpy = [0.4, -0.7, 1.9]
velocity = [0.1, 0.2, -0.3]
angular_velocity = [0.6, -0.5, 0.8]
[initial.joints.fly]
position = [0.1, 0.2, 0.3, 0.5, -0.4, 2.0]
velocity = [-0.3, 0.2, 0.1, 0.7, 0.9, -0.6]
[initial.joints]
turn = { position = 0.8, velocity = 2.0 }
slide = { position = -0.2, velocity = 0.4 }
glide = { position = [0.1, -0.3, 0.5], velocity = [0.2, 0.1, -0.9] }
[[load]]
name = "push"
link = "tool"
point = [0.1, 0.2, 0.0]
force = [3.0, -2.0, 5.0]
moment = [0.1, 0.2, -0.3]
time = { kind = "pulse", shape = "rectangular", start = 0.0123, duration = 0.0211 }
[[load]]
name = "hum"
link = "gliding"
force = [1.0, 2.0, -1.0]
frame = "world"
time = { kind = "sinusoid", frequency = 7.0, phase = 0.3 }
)";
}

/// The bodies of `scene` at time 0 by Simbody's kinematics.
Snapshot start_of(const RigidScene& scene, JointModel joints) {
  return simulate(make_mechanism(scene.scene, scene.built), {joints, 1e-6},
                  {{1e-6, false, true}})
      .snapshots.front();
}

// Merging, centres of mass, joint coordinates of every kind: by programs that
// share no code.
TEST(SimbodyReference, FindsOurInitialStateByItsOwnKinematics) {
  const RigidScene scene(make_zoo(kStiffness, 10.0),
                         make_zoo_scenario(0.1, 1e-4));
  for (const JointModel joints : {JointModel::bushings, JointModel::ideal}) {
    const Snapshot start = start_of(scene, joints);
    ASSERT_EQ(start.frames.size(), 5U);
    const Agreement agreement = compare(
        {start}, {scene.built.initial},
        {dynamics::calc_energy(scene.built.model, scene.built.initial)});
    EXPECT_LT(agreement.largest.position, kRoundOff);
    EXPECT_LT(agreement.largest.rotation, kRoundOff);
    EXPECT_LT(agreement.largest.velocity, kRoundOff);
    EXPECT_LT(agreement.largest.angular_velocity, kRoundOff);
    // Nothing else moves the same way by accident.
    EXPECT_GT(start.frames[3].w_WB_B.norm(), 0.1);
    // Both keep a free rotation's stiffness as zero to round-off of the others.
    EXPECT_LT(agreement.energy, 2.2e-16 * kStiffness);
  }
}

// Bushings, springs, dampers, pulses in body axes, forces in world axes,
// gravity, in one motion.
TEST(Verify, EqualLawsAgreeAtTheOrderOfOurScheme) {
  const RigidScene scene(make_zoo(1e4, 5.0), make_zoo_scenario(0.1, 4e-4));
  const Verification result =
      verify(scene.scene, scene.built, {{JointModel::bushings, 1e-11}, 2});
  ASSERT_EQ(result.runs.size(), 3U);
  std::vector<double> relative;
  for (const Agreement& run : result.runs) {
    relative.push_back(find_relative(run.largest, result.motion));
  }
  EXPECT_NEAR(std::log2(relative[0] / relative[1]), 4.0, 0.4);
  EXPECT_NEAR(std::log2(relative[1] / relative[2]), 4.0, 0.4);
  EXPECT_LT(relative[2], 1e-6);
  EXPECT_LT(result.runs[2].energy, 1e-6 * result.energy);
}

TEST(Verify, RefusesLinksAboveRigid) {
  RigidScene scene(make_zoo(1e4, 5.0), make_zoo_scenario(0.1, 4e-4));
  scene.built.model.bodies[1].fidelity = dynamics::Fidelity::coupled;
  EXPECT_THROW((void)make_mechanism(scene.scene, scene.built), InputError);
}

TEST(JointModel, UnknownNameIsRefusedWithTheNearest) {
  EXPECT_EQ(parse_joint_model("ideal"), JointModel::ideal);
  EXPECT_THROW((void)parse_joint_model("idael"), InputError);
}

}  // namespace
}  // namespace limber::reference::verification_test
