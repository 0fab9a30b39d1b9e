// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "limber/flexbody/file/body_file.hpp"
#include "support/point_mass_body.hpp"
#include "unit/scene/scene_folder.hpp"
#include "unit/scene/temporary_file.hpp"

/// Scenes from their files to their motion, against closed forms.
namespace limber::scene::build_system_test {
namespace {

using test::input_error;
using test::kWorld;
using test::rigid_link;
using test::SceneFolder;
using test::simulate_probes;
using test::time_table;
using ::testing::HasSubstr;

std::string joint(const std::string& type, const std::string& axis = "0 0 1",
                  const std::string& limits = "") {
  return fmt::format(
      "<joint name='j' type='{}'><parent link='world'/><child link='body'/>"
      "<axis xyz='{}'/>{}</joint>\n",
      type, axis, limits);
}

const std::string kLimits =
    "<limit lower='-9' upper='9' effort='1' velocity='1'/>";
const std::string kProbe =
    "[[probe]]\nname = 'p'\nlink = 'body'\nquantity = 'position'\n";

// Half a turn and fifty: the point is where its angle says.
TEST(BuildSystem, ContinuousJointTurnsAnyNumberOfTimes) {
  for (const double turns : {0.5, 50.25}) {
    const SceneFolder folder;
    const double rate = 2.0 * std::numbers::pi * turns;
    const double step = 2e-5;
    const BuiltScene built = folder.build(
        kWorld + rigid_link("body", 2.0, 0.1, "1 0 0") + joint("continuous") +
            "<coupler joint='j' translational_stiffness='1e13'/>\n",
        time_table(1.0, step) +
            fmt::format("[initial.joints]\nj = {{ velocity = {} }}\n", rate) +
            kProbe + "point = [1.0, 0.0, 0.0]\n");
    const auto p = simulate_probes(built);
    // The joint deflects by m w^2 r / k, which reduces the spin; the
    // integrator's error is of second order in a step's angle.
    const double tolerance = rate * (10.0 * 2.0 * rate * rate / 1e13 +
                                     0.5 * std::pow(rate * step, 2));
    EXPECT_NEAR(p[0], std::cos(rate), tolerance);
    EXPECT_NEAR(p[1], std::sin(rate), tolerance);
    EXPECT_NEAR(p[2], 0.0, 1e-9);
  }
}

// m x'' = -k x from rest at its free length plus 0.1 m.
TEST(BuildSystem, MassOnASpringOscillatesAtItsFrequency) {
  const SceneFolder folder;
  const double omega = std::sqrt(800.0 / 2.0);
  const double period = 2.0 * std::numbers::pi / omega;
  const BuiltScene built = folder.build(
      kWorld + rigid_link("body", 2.0, 0.1) +
          joint("prismatic", "1 0 0", kLimits) +
          "<spring name='s' from='world' from_xyz='-1 0 0' to='body' "
          "stiffness='800' free_length='1'/>\n",
      time_table(1.25 * period, 1e-4) +
          "[initial.joints]\nj = { position = 0.1 }\n" + kProbe +
          "[[probe]]\nname = 'v'\nlink = 'body'\nquantity = 'velocity'\n");
  EXPECT_NEAR(evaluate_all(built.probes, built.model, built.initial)[0], 0.1,
              1e-12);
  const auto end = simulate_probes(built);  // 5/4 periods: zero, backwards
  EXPECT_NEAR(end[0], 0.0, 1e-5);
  EXPECT_NEAR(end[3], -0.1 * omega, 1e-4);
}

// I phi'' = -k phi for a bushing about the axis of a revolute joint.
TEST(BuildSystem, BushingAboutAHingeIsATorsionSpring) {
  const SceneFolder folder;
  const double omega = std::sqrt(40.0 / 0.1);
  const double start = 0.01;  // small: the bushing's law is chordal
  const BuiltScene built = folder.build(
      kWorld + rigid_link("body", 2.0, 0.1) +
          joint("revolute", "0 0 1", kLimits) +
          "<bushing name='b' from='world' to='body' "
          "translational_stiffness='0' rotational_stiffness='0 0 40'/>\n",
      time_table(2.25 * std::numbers::pi / omega, 1e-4) +
          fmt::format("[initial.joints]\nj = {{ velocity = {} }}\n",
                      start * omega) +
          "[[probe]]\nname = 'p'\nlink = 'body'\nquantity = 'rotation'\n");
  EXPECT_NEAR(simulate_probes(built)[2],
              start * std::sin(2.25 * std::numbers::pi), 1e-6);
}

TEST(BuildSystem, PlanarJointHoldsItsNormalAlone) {
  const SceneFolder folder;
  const BuiltScene built = folder.build(
      kWorld + rigid_link("body", 2.0, 0.1) + joint("planar", "0 0 1"),
      time_table(1.0, 1e-3) +
          "[gravity]\nacceleration = [0.0, -2.0, -9.81]\n"
          "[initial.joints]\nj = { velocity = [3.0, 0.0, 0.5] }\n" +
          kProbe +
          "[[probe]]\nname = 'r'\nlink = 'body'\nquantity = "
          "'rotation'\n");
  const auto end = simulate_probes(built);
  EXPECT_NEAR(end[0], 3.0, 1e-9);
  EXPECT_NEAR(end[1], -1.0, 1e-6);  // - 2 t^2 / 2
  EXPECT_NEAR(end[2], 0.0, 1e-5);   // hangs on a stiff coupler
  EXPECT_NEAR(end[5], 0.5, 1e-9);
}

TEST(BuildSystem, FloatingJointLeavesEverythingFree) {
  const SceneFolder folder;
  const BuiltScene built = folder.build(
      kWorld + rigid_link("body", 2.0, 0.1) + joint("floating"),
      time_table(1.0, 1e-3) +
          "[gravity]\nacceleration = [0.0, 0.0, -9.81]\n"
          "[initial.joints]\nj = { position = [1.0, 2.0, 3.0, 0.0, 0.0, 0.0], "
          "velocity = [0.0, 1.0, 0.0, 0.0, 0.0, 0.0] }\n" +
          kProbe);
  const auto end = simulate_probes(built);
  EXPECT_NEAR(end[0], 1.0, 1e-12);
  EXPECT_NEAR(end[1], 3.0, 1e-9);
  EXPECT_NEAR(end[2], 3.0 - 4.905, 1e-6);
}

TEST(BuildSystem, RefusesABodySoFarAwayThatItsPositionHasNoDigitsLeft) {
  const SceneFolder folder;
  const std::string robot =
      kWorld + rigid_link("body", 2.0, 0.1) + joint("floating");
  const auto place = [](const std::string& x) {
    return time_table(1.0, 0.1) +
           fmt::format(
               "[initial.joints]\nj = {{ position = [{}, 0, 0, 0, 0, "
               "0] }}\n",
               x) +
           kProbe;
  };
  EXPECT_NO_THROW((void)folder.build(robot, place("1e6")));
  EXPECT_THAT(input_error([&] { (void)folder.build(robot, place("1e300")); }),
              HasSubstr("body 'body' at t = 0 s is 1e+300 m from the origin"));
}

TEST(BuildSystem, SceneInWhichNothingCanMoveIsRefused) {
  const SceneFolder folder;
  EXPECT_THAT(input_error([&] {
                (void)folder.build(
                    kWorld + rigid_link("body", 2.0, 0.1) + joint("fixed"),
                    time_table(0.1, 1e-3));
              }),
              HasSubstr("no body that can move"));
}

// Force m a at the centre of mass: x = a t^2 / 2, twice as much with a world
// load and gravity alike.
TEST(BuildSystem, LoadAndGravityAccelerateAlike) {
  const SceneFolder folder;
  const BuiltScene built = folder.build(
      rigid_link("body", 2.0, 0.1, "0.3 0 0"),
      time_table(1.0, 1e-2) + "[gravity]\nacceleration = [1.5, 0.0, 0.0]\n" +
          "[[load]]\nname = 'f'\nlink = 'body'\npoint = [0.3, 0.0, 0.0]\n"
          "force = [3.0, 0.0, 0.0]\nframe = 'world'\n"
          "time = { kind = 'constant' }\n" +
          kProbe);
  EXPECT_NEAR(simulate_probes(built)[0], 1.5, 1e-9);
}

std::string reduced_link(const std::filesystem::path& file,
                         const std::string& more = "") {
  return fmt::format(
      "<link name='body'/>\n<flexible link='body'><reduced file='{}'/>{}"
      "</flexible>\n",
      file.string(), more);
}

flexbody::ReducedBody saved_body() {
  auto body = testing::make_point_mass_body(12, 3, 5.0, 1.0, 300.0, 3);
  body.reduced.interfaces = {testing::make_interface(body, 0, 5),
                             testing::make_interface(body, 5, 12)};
  body.reduced.interfaces[0].name = "root";
  body.reduced.interfaces[1].name = "tip";
  return body.reduced;
}

class SavedBody : public ::testing::Test {
 protected:
  void SetUp() override {
    flexbody::write_body(saved_body(), folder_.path() / "body.h5");
  }
  [[nodiscard]] BuiltScene build(const std::string& scenario) const {
    return folder_.build(reduced_link("body.h5"),
                         time_table(0.1, 1e-3) + scenario);
  }
  SceneFolder folder_;
};

TEST_F(SavedBody, StandsForItsMesh) {
  const BuiltScene built = build("");
  ASSERT_EQ(built.model.bodies.size(), 1U);
  EXPECT_EQ(built.model.bodies[0].modes, 3);
  EXPECT_NEAR(built.model.bodies[0].mass, 5.0, 1e-12);
  EXPECT_EQ(built.bodies_reduced, 0);
}

TEST_F(SavedBody, IsRefusedWithAClampThatItWasMadeWithout) {
  EXPECT_THAT(input_error([&] {
                (void)folder_.build(
                    reduced_link("body.h5", "<clamp group='root'/>"),
                    time_table(0.1, 1e-3));
              }),
              HasSubstr("its saved body was made without one"));
}

TEST_F(SavedBody, IsOneForAllLinksOfItsFile) {
  const std::string second =
      "<link name='other'/>\n"
      "<flexible link='other'><reduced file='body.h5'/></flexible>\n"
      "<joint name='o' type='floating'><parent link='body'/>"
      "<child link='other'/></joint>\n";
  const BuiltScene built =
      folder_.build(reduced_link("body.h5") + second, time_table(0.1, 1e-3));
  ASSERT_EQ(built.model.bodies.size(), 2U);
  EXPECT_EQ(built.model.bodies[0].reduced, built.model.bodies[1].reduced);
}

TEST_F(SavedBody, LosesItsModesAtLevelRigid) {
  const BuiltScene built =
      build("[fidelity]\ndefault = 'coupled'\nlinks = { body = 'rigid' }\n");
  EXPECT_EQ(built.model.bodies[0].modes, 0);
  EXPECT_EQ(built.model.bodies[0].fidelity, dynamics::Fidelity::rigid);
}

TEST_F(SavedBody, TakesLoadsAndProbesAtItsInterfaces) {
  const BuiltScene built = build(
      "[[load]]\nname = 'f'\nlink = 'body'\ninterface = 'tip'\n"
      "force = [0.0, 50.0, 0.0]\nframe = 'world'\n"
      "time = { kind = 'constant' }\n"
      "[[probe]]\nname = 'p'\nlink = 'body'\ninterface = 'tip'\n"
      "quantity = 'deformation'\n");
  // The impulse F t, for any internal motion of the body.
  dynamics::SystemState state = built.initial;
  dynamics::EnergyBalance end;
  dynamics::simulate(
      built.model, state, built.settings,
      [&](const auto&, const dynamics::EnergyBalance& now) { end = now; });
  EXPECT_NEAR(end.linear_momentum.y(), 5.0, 1e-9);
  const auto p = evaluate_all(built.probes, built.model, state);
  EXPECT_GT(std::hypot(p.at(0), p.at(1), p.at(2)), 1e-9);
}

TEST_F(SavedBody, RefusesNodesAndInterfacesThatItDoesNotHave) {
  EXPECT_THAT(input_error([&] {
                (void)build(
                    "[[probe]]\nname = 'p'\nlink = 'body'\n"
                    "interface = 'tpi'\n");
              }),
              HasSubstr("tip"));
  EXPECT_THAT(
      input_error([&] {
        (void)build("[[probe]]\nname = 'p'\nlink = 'body'\nnode = 99\n");
      }),
      HasSubstr("99"));
}

// Loops, springs, tendons and latches follow a bending link's interfaces, and
// their frames lie where the points say.
TEST_F(SavedBody, HoldsCouplersAtItsInterfaces) {
  const auto body = saved_body();
  const Vector3 tip_L = body.interfaces[1].p_B + body.p_MoBcm_M;
  const std::string tip =
      fmt::format("{} {} {}", tip_L.x(), tip_L.y(), tip_L.z());
  const std::string ends =
      "<from link='body' interface='tip'/>"
      "<to link='world' point='" +
      tip + "'/>";
  const BuiltScene built = folder_.build(
      reduced_link("body.h5") + "<loop name='o' kind='ball'>" + ends +
          "</loop><latch name='l' reach='1'>" + ends +
          "</latch>"
          "<bushing name='b' translational_stiffness='3'><from link='body' "
          "interface='root' point='1 2 3'/><to link='world'/></bushing>"
          "<tendon name='t' stiffness='2'><via link='body' interface='root'/>"
          "<via link='world' point='9 9 9'/></tendon>",
      time_table(0.1, 1e-3));
  for (const char* name : {"o.F", "l.F", "b.F", "t.1"}) {
    const auto attachment = std::find_if(
        built.model.attachments.begin(), built.model.attachments.end(),
        [&](const auto& a) { return a.name == name; });
    ASSERT_NE(attachment, built.model.attachments.end()) << name;
    EXPECT_EQ(attachment->body, 0) << name;
    EXPECT_EQ(attachment->Phi_B.cols(), 3) << name;
    EXPECT_FALSE(attachment->Phi_B.isZero()) << name;
  }
  const auto& bushing = built.model.attachments[static_cast<std::size_t>(
      built.model.couplers[1].frame_F)];
  EXPECT_TRUE(bushing.p_BF.isApprox(Vector3(1, 2, 3) - body.p_MoBcm_M, 1e-14));
}

TEST_F(SavedBody, RefusesCouplersThatHoldNoNodes) {
  const auto error_of = [&](const std::string& link, const std::string& end) {
    return input_error([&] {
      (void)folder_.build(link + "<spring name='s' stiffness='1'><from " + end +
                              "/><to link='world' point='1 0 0'/></spring>",
                          time_table(0.1, 1e-3));
    });
  };
  EXPECT_THAT(error_of(reduced_link("body.h5"), "link='body'"),
              HasSubstr("connector 's': link 'body' is flexible"));
  EXPECT_THAT(
      error_of(rigid_link("body", 1.0, 1.0), "link='body' interface='tip'"),
      HasSubstr("connector 's': link 'body' is rigid and has no nodes"));
}

}  // namespace
}  // namespace limber::scene::build_system_test
