// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "limber/scene/build/scene_checks.hpp"
#include "unit/scene/scene_folder.hpp"
#include "unit/scene/temporary_file.hpp"

/// Couplers built from a robot and a scenario: laws, their parameters, frames
/// and axes.
namespace limber::scene::coupler_assembly_test {
namespace {

using joints::JointKind;
using test::input_error;
using test::kWorld;
using test::rigid_link;
using test::SceneFolder;
using test::time_table;
using ::testing::HasSubstr;

constexpr double kPi = std::numbers::pi;
const std::string kTime = time_table(0.1, 1e-3);

std::string joint(const std::string& name, const std::string& child,
                  const std::string& type, const std::string& more = "",
                  const std::string& parent = "world") {
  return fmt::format(
      "<joint name='{}' type='{}'><parent link='{}'/><child link='{}'/>"
      "<axis xyz='0 0 1'/><limit effort='0' velocity='0'/>{}</joint>\n",
      name, type, parent, child, more);
}

/// Bodies a (2 kg, 0.1 kg m^2) and b (4 kg, 0.3 kg m^2) on joints j and k.
std::string two_bodies(const std::string& type_j, const std::string& type_k,
                       const std::string& more_j = "") {
  return kWorld + rigid_link("a", 2.0, 0.1) + rigid_link("b", 4.0, 0.3) +
         joint("j", "a", type_j, more_j) + joint("k", "b", type_k);
}

const dynamics::Coupler& coupler(const dynamics::SystemModel& model,
                                 const std::string& name) {
  for (const dynamics::Coupler& c : model.couplers) {
    if (c.name == name) return c;
  }
  throw std::logic_error("no coupler " + name);
}

const joints::Joint& joint_law(const dynamics::SystemModel& model,
                               const std::string& name) {
  return std::get<joints::Joint>(coupler(model, name).law);
}

template <typename Law>
const Law& element(const joints::Joint& joint, std::size_t i) {
  return std::get<Law>(joint.elements().at(i).law);
}

const dynamics::Transmission& transmission(const dynamics::SystemModel& model,
                                           const std::string& name) {
  for (const dynamics::Transmission& t : model.transmissions) {
    if (t.name == name) return t;
  }
  throw std::logic_error("no transmission " + name);
}

// Stiffness with which 1 kg (1 kg m^2) swings at 20 kHz, and the damping of
// 10 % of critical: docs/reference/joints.md.
constexpr double kUnitStiffness = 16e8 * kPi * kPi;
double default_damping(double stiffness, double mu) {
  return 0.2 * std::sqrt(stiffness * mu);
}

// Stiffness with which 1 kg (1 kg m^2) swings at 50 Hz.
constexpr double kUnitStop = 1e4 * kPi * kPi;

TEST(CouplerAssembly, StopIsAsStiffAsTheMassThatHitsItUnlessGivenOtherwise) {
  const SceneFolder folder;
  const BuiltScene built = folder.build(
      two_bodies("revolute", "prismatic") +
          "<coupler joint='j'><stop lower='-1' upper='2'/></coupler>"
          "<coupler joint='k'><stop upper='3' damping='5'/></coupler>",
      kTime);
  const auto& turn =
      element<joints::EndStop>(joint_law(built.model, "j"), 0).parameters();
  EXPECT_EQ(turn.lower, -1.0);
  EXPECT_EQ(turn.upper, 2.0);
  EXPECT_NEAR(turn.stiffness, 0.1 * kUnitStop, 1e-9 * turn.stiffness);
  EXPECT_EQ(turn.damping, joints::find_stop_damping(0.5, 1.0));
  const auto& slide =
      element<joints::EndStop>(joint_law(built.model, "k"), 0).parameters();
  EXPECT_EQ(slide.lower, -joints::EndStop::kUnbounded);
  EXPECT_NEAR(slide.stiffness, 4.0 * kUnitStop, 1e-9 * slide.stiffness);
  EXPECT_EQ(slide.damping, 5.0);
}

TEST(CouplerAssembly, FrictionAndSpringsActOnTheirCoordinates) {
  const SceneFolder folder;
  const BuiltScene built = folder.build(
      two_bodies("planar", "continuous", "<dynamics damping='7'/>") +
          "<coupler joint='j'><friction coordinate='2' coulomb='3'/>"
          "<spring coordinate='3' stiffness='5' rest='0.5'/></coupler>",
      kTime);
  const joints::Joint& law = joint_law(built.model, "j");
  ASSERT_EQ(law.elements().size(), 2U);
  EXPECT_EQ(law.elements()[0].coordinate, 1);
  EXPECT_EQ(element<joints::Friction>(law, 0).parameters().coulomb, 3.0);
  EXPECT_EQ(law.elements()[1].coordinate, 2);
  EXPECT_EQ(element<joints::ScalarSpring>(law, 1).parameters().rest, 0.5);
  const auto& constraint =
      std::get<joints::Bushing>(law.constraint()).parameters();
  EXPECT_EQ(constraint.translational_damping(0, 0), 7.0);  // <dynamics> stays
}

TEST(CouplerAssembly, UniversalAndBallJointsTakeTheirAxes) {
  const SceneFolder folder;
  const BuiltScene built =
      folder.build(two_bodies("floating", "floating") +
                       "<coupler joint='j' kind='universal' axis='0 0 1' "
                       "second_axis='0 1 0'/><coupler joint='k' kind='ball'/>",
                   kTime);
  const joints::Joint& universal = joint_law(built.model, "j");
  const auto& constraint =
      std::get<joints::UniversalConstraint>(universal.constraint());
  EXPECT_EQ(constraint.parameters().axis_F, Vector3::UnitZ());
  EXPECT_EQ(constraint.parameters().axis_M, Vector3::UnitY());
  EXPECT_NEAR(constraint.parameters().translational_stiffness,
              2.0 * kUnitStiffness, 1e-9 * kUnitStiffness);
  const joints::Joint& ball = joint_law(built.model, "k");
  EXPECT_EQ(ball.coordinates().size(), 3U);
  const auto& held = std::get<joints::Bushing>(ball.constraint()).parameters();
  EXPECT_TRUE(held.rotational_stiffness.isZero());
}

TEST(CouplerAssembly, DrivesKeepTheLimitsOfTheirJointUnlessTheyHaveTheirOwn) {
  const SceneFolder folder;
  Scene scene = folder.load(
      kWorld + rigid_link("a", 2.0, 0.1) +
          "<joint name='j' type='continuous'><parent link='world'/>"
          "<child link='a'/><limit effort='5' velocity='3'/></joint>",
      kTime);
  joints::Drive::Parameters drive;
  drive.mode = joints::DriveMode::effort;
  drive.signal.base = joints::ConstantSignal{1.0};
  scene.scenario.drives.push_back({"first", "j", "", 1, drive});
  drive.max_effort = 2.0;
  drive.max_speed = 9.0;
  scene.scenario.drives.push_back({"second", "j", "", 1, drive});
  const BuiltScene built = folder.build(scene);
  const joints::Joint& law = joint_law(built.model, "j");
  const auto& first = element<joints::Drive>(law, 0).parameters();
  EXPECT_EQ(first.max_effort, 5.0);
  EXPECT_EQ(first.max_speed, 3.0);
  const auto& second = element<joints::Drive>(law, 1).parameters();
  EXPECT_EQ(second.max_effort, 2.0);
  EXPECT_EQ(second.max_speed, 9.0);
}

TEST(CouplerAssembly, DriveOnATendonOnlyPulls) {
  const SceneFolder folder;
  Scene scene = folder.load(
      kWorld + rigid_link("a", 2.0, 0.1) + joint("j", "a", "continuous") +
          "<tendon name='t'><via link='world' point='3 4 0'/>"
          "<via link='a'/></tendon>",
      kTime);
  joints::Drive::Parameters drive;
  drive.mode = joints::DriveMode::effort;
  drive.signal.base = joints::ConstantSignal{1.0};
  scene.scenario.drives.push_back({"winch", "", "t", 1, drive});
  const BuiltScene built = folder.build(scene);
  const auto& laws = transmission(built.model, "t").laws;
  ASSERT_EQ(laws.size(), 1U);
  EXPECT_TRUE(std::get<joints::Drive>(laws[0]).parameters().pulls_only);
}

TEST(CouplerAssembly, DrivesAndReleasesNeedWhatTheyName) {
  const SceneFolder folder;
  const auto error_of = [&](const DriveSpec& drive) {
    Scene scene = folder.load(two_bodies("fixed", "planar"), kTime);
    scene.scenario.drives.push_back(drive);
    return input_error([&] { check_scenario(scene.scenario, scene.robot); });
  };
  EXPECT_THAT(error_of({"d", "j", "", 1, {}}),
              HasSubstr("drive 'd': joint 'j' is fixed: it has no coordinate"));
  EXPECT_THAT(error_of({"d", "k", "", 4, {}}),
              HasSubstr("coordinate 4: joint 'k' has 3"));
  EXPECT_THAT(error_of({"d", "kk", "", 1, {}}),
              HasSubstr("unknown joint 'kk'"));
  EXPECT_THAT(error_of({"d", "", "t", 1, {}}), HasSubstr("unknown tendon 't'"));
  Scene scene = folder.load(two_bodies("fixed", "planar"), kTime);
  scene.scenario.releases["grip"] = 1.0;
  EXPECT_THAT(input_error([&] { check_scenario(scene.scenario, scene.robot); }),
              HasSubstr("unknown latch 'grip'"));
}

TEST(CouplerAssembly, TendonIsAsLongAsItStartsUnlessGivenOtherwise) {
  const SceneFolder folder;
  const std::string via =
      "><via link='world' point='3 4 0'/><via link='a'/>"
      "<via link='world' point='-2 0 0'/></tendon>";
  const BuiltScene built = folder.build(
      kWorld + rigid_link("a", 2.0, 0.1) + joint("j", "a", "continuous") +
          "<tendon name='t' stiffness='10' damping='2'" + via +
          "<tendon name='u' stiffness='10' pretension='5'" + via +
          "<tendon name='v' stiffness='10' free_length='1' tension='6'" + via,
      kTime);
  const auto spring = [&](const std::string& name) {
    return std::get<joints::ScalarSpring>(
               transmission(built.model, name).laws.at(0))
        .parameters();
  };
  EXPECT_EQ(spring("t").curve.parameters().stiffness, 10.0);
  EXPECT_EQ(spring("t").damping, 2.0);
  EXPECT_TRUE(spring("t").tension_only);
  EXPECT_NEAR(spring("t").rest, 7.0, 1e-14);
  EXPECT_NEAR(spring("u").rest, 6.5, 1e-14);  // 7 - 5 / 10
  EXPECT_EQ(spring("v").rest, 1.0);
  const auto& pull =
      std::get<joints::Drive>(transmission(built.model, "v").laws.at(1));
  EXPECT_TRUE(pull.parameters().pulls_only);
  EXPECT_EQ(joints::evaluate(pull.parameters().signal, {}).value, 6.0);
}

TEST(CouplerAssembly, GearIsAsStiffAsItsSofterJoint) {
  const SceneFolder folder;
  const auto spring = [&](const std::string& more) {
    const BuiltScene built =
        folder.build(two_bodies("continuous", "continuous") +
                         "<gear name='g' joint='j' with='k' " + more + "/>",
                     kTime);
    const auto& gear = transmission(built.model, "g");
    const auto& sum = std::get<dynamics::JointSum>(gear.coordinate);
    EXPECT_EQ(sum.terms.at(0).factor, 1.0);
    return std::pair(
        std::get<joints::ScalarSpring>(gear.laws.at(0)).parameters(), sum);
  };
  const auto [one, sum] = spring("ratio='1' offset='0.5'");
  EXPECT_EQ(sum.terms.at(1).factor, -1.0);
  EXPECT_EQ(sum.offset, 0.5);
  const double k_j = 0.1 * kUnitStiffness;  // of j, the softer
  EXPECT_NEAR(one.curve.parameters().stiffness, k_j, 1e-9 * k_j);
  EXPECT_NEAR(one.damping, default_damping(k_j, 0.1), 1e-9 * one.damping);
  // Referred to j, k is softer by the square of the ratio.
  const double k_k = 0.3 * kUnitStiffness / 9.0;
  const auto [three, unused] = spring("ratio='3'");
  EXPECT_NEAR(three.curve.parameters().stiffness, k_k, 1e-9 * k_k);
  EXPECT_NEAR(three.damping, default_damping(0.3 * kUnitStiffness, 0.3) / 9.0,
              1e-9 * three.damping);
  const auto [given, also_unused] =
      spring("ratio='3' stiffness='11' damping='12'");
  EXPECT_EQ(given.curve.parameters().stiffness, 11.0);
  EXPECT_EQ(given.damping, 12.0);
}

TEST(CouplerAssembly, PointsOfABushingMeetAtTheStart) {
  const SceneFolder folder;
  const auto error = [&](const std::string& to) {
    return test::input_error([&] {
      (void)folder.build(two_bodies("revolute", "revolute") +
                             "<bushing name='n' rotational_stiffness='1'>"
                             "<from link='world' point='1 2 3'/>"
                             "<to link='a' point='" +
                             to + "'/></bushing>",
                         kTime);
    });
  };
  EXPECT_EQ(error("1 2 3"), "");
  EXPECT_THAT(error("1 2 2"),
              ::testing::HasSubstr("'n': its ends are 1 m apart at the start"));
}

TEST(CouplerAssembly, GearThatStartsOutOfPlaceGivesOneWarning) {
  const SceneFolder folder;
  const auto warnings = [&](const std::string& start) {
    return folder
        .build(two_bodies("continuous", "continuous") +
                   "<gear name='g' joint='j' with='k' ratio='-2' "
                   "offset='0.5'/>",
               kTime + start)
        .warnings;
  };
  EXPECT_TRUE(warnings("[initial.joints]\nj={position=-0.1}\n"
                       "k={position=0.3}\n")
                  .empty());
  EXPECT_THAT(warnings("[initial.joints]\nj={position=0}\nk={position=0}\n"),
              ::testing::ElementsAre("gear 'g' starts strained by -0.5: joint "
                                     "'j' is at 0, and joint 'k' requires "
                                     "0.5"));
  // A joint without a start is put where its gear has it.
  EXPECT_TRUE(warnings("").empty());
  EXPECT_TRUE(warnings("[initial.joints]\nk={position=0.3}\n").empty());
  EXPECT_TRUE(warnings("[initial.joints]\nj={position=0.3}\n").empty());
}

TEST(CouplerAssembly, LatchHoldsLikeAFixedJointUntilItsRelease) {
  const SceneFolder folder;
  Scene scene = folder.load(
      two_bodies("floating", "floating") +
          "<latch name='l' from='a' to='b' reach='0.1' release_time='3' "
          "rotational_stiffness='5'/>",
      kTime);
  const auto latch = [&] {
    const BuiltScene built = folder.build(scene);
    return std::get<joints::Latch>(coupler(built.model, "l").law).parameters();
  };
  EXPECT_EQ(latch().reach, 0.1);
  EXPECT_EQ(latch().release_time, 3.0);
  EXPECT_EQ(latch().bushing.rotational_stiffness,
            Matrix3(5.0 * Matrix3::Identity()));
  const double stiffness = kUnitStiffness / (1.0 / 2.0 + 1.0 / 4.0);
  EXPECT_NEAR(latch().bushing.translational_stiffness(1, 1), stiffness,
              1e-9 * stiffness);
  scene.scenario.releases["l"] = 1.5;
  EXPECT_EQ(latch().release_time, 1.5);
}

TEST(CouplerAssembly, SpringTakesItsCurve) {
  const SceneFolder folder;
  const BuiltScene built = folder.build(
      kWorld + rigid_link("a", 2.0, 0.1) + joint("j", "a", "continuous") +
          "<spring name='s' from='world' from_xyz='3 4 0' to='a' quadratic='8' "
          "tension_only='true'/>",
      kTime);
  const auto& spring =
      std::get<joints::PointSpring>(coupler(built.model, "s").law).parameters();
  EXPECT_EQ(spring.quadratic, 8.0);
  EXPECT_TRUE(spring.tension_only);
  EXPECT_NEAR(spring.free_length, 5.0, 1e-14);
}

/// Two links one below the other, turned at the start, and a loop that holds
/// the lower one's end at (2, 0, 0).
std::string chain(const std::string& loop) {
  return kWorld + rigid_link("a", 2.0, 0.1) + rigid_link("b", 4.0, 0.3) +
         joint("j", "a", "continuous") +
         joint("k", "b", "continuous", "<origin xyz='1 0 0'/>", "a") + loop;
}

// In the configuration of zero both frames of a loop are one.
TEST(CouplerAssembly, LoopRestsWhereAllJointsAreAtZero) {
  const SceneFolder folder;
  const BuiltScene built =
      folder.build(chain("<loop name='o' kind='revolute' axis='0 0 1'>"
                         "<from link='b' point='1 0 0' rpy='0 0 0.25'/>"
                         "<to link='world' point='2 0 0'/></loop>"),
                   kTime + "[initial.joints]\nj = { position = 0.5 }\n");
  const dynamics::Coupler& loop = coupler(built.model, "o");
  const auto& F =
      built.model.attachments[static_cast<std::size_t>(loop.frame_F)];
  const auto& M =
      built.model.attachments[static_cast<std::size_t>(loop.frame_M)];
  EXPECT_EQ(F.body, 1);
  EXPECT_TRUE(F.p_BF.isApprox(Vector3::UnitX(), 1e-14));
  EXPECT_EQ(M.body, dynamics::kWorld);
  EXPECT_TRUE(M.p_BF.isApprox(Vector3(2, 0, 0), 1e-14));
  EXPECT_TRUE(M.R_BF.isApprox(F.R_BF, 1e-14));
  EXPECT_NEAR(F.R_BF(1, 0), std::sin(0.25), 1e-14);
  EXPECT_EQ(joint_law(built.model, "o").coordinates().size(), 1U);
}

TEST(CouplerAssembly, LoopIsDrivenAndGearedLikeAJoint) {
  const SceneFolder folder;
  Scene scene =
      folder.load(chain("<loop name='o' kind='revolute' axis='0 0 1' from='b' "
                        "from_xyz='1 0 0' to='world' to_xyz='2 0 0'/>"
                        "<gear name='g' joint='o' with='j' ratio='-1'/>"),
                  kTime);
  joints::Drive::Parameters drive;
  drive.mode = joints::DriveMode::effort;
  drive.signal.base = joints::ConstantSignal{1.0};
  scene.scenario.drives.push_back({"d", "o", "", 1, drive});
  const BuiltScene built = folder.build(scene);
  EXPECT_EQ(joint_law(built.model, "o").elements().size(), 1U);
  const auto& sum =
      std::get<dynamics::JointSum>(transmission(built.model, "g").coordinate);
  EXPECT_EQ(
      built.model.couplers[static_cast<std::size_t>(sum.terms[0].coupler)].name,
      "o");
}

TEST(CouplerAssembly, RefusesWhatCannotBePutTogether) {
  const SceneFolder folder;
  const auto error_of = [&](const std::string& robot) {
    return input_error([&] { (void)folder.build(robot, kTime); });
  };
  EXPECT_THAT(
      error_of(chain("<loop name='o' kind='ball' from='b' from_xyz='1 0 0' "
                     "to='world' to_xyz='2 0.01 0'/>")),
      HasSubstr("loop 'o': its ends are 0.01 m apart where all joints"));
  EXPECT_THAT(error_of(chain("<loop name='o' kind='ball' from='b' to='b'/>")),
              HasSubstr("both of its ends are on the same body"));
  EXPECT_THAT(error_of(chain("<tendon name='t'><via link='a'/><via link='a' "
                             "point='1 0 0'/></tendon>")),
              HasSubstr("tendon 't'"));
  EXPECT_THAT(error_of(chain("<tendon name='t'><via link='a' point='1 0 0'/>"
                             "<via link='b'/></tendon>")),
              HasSubstr("tendon 't': its points 1 and 2 meet at the start"));
}

// A chain of gears, of which one end is given.
TEST(CouplerAssembly, GearedJointsStartWhereTheOthersPutThem) {
  const SceneFolder folder;
  const std::string robot =
      kWorld + rigid_link("a", 2.0, 0.1) + rigid_link("b", 4.0, 0.3) +
      rigid_link("c", 1.0, 0.2) + joint("j", "a", "continuous") +
      joint("k", "b", "continuous",
            "<mimic joint='j' multiplier='-2' offset='0.5'/>") +
      joint("l", "c", "prismatic") +
      "<gear name='g' joint='k' with='l' ratio='10'/>";
  const auto starts = [&](const std::string& initial) {
    const BuiltScene built = folder.build(robot, kTime + initial);
    std::vector<double> q;
    for (std::size_t c = 0; c < built.model.couplers.size(); ++c) {
      q.push_back(built.initial.memory[c].near[0]);
    }
    q.push_back(built.initial.bodies[1].w_WB_B.z());
    q.push_back(built.initial.bodies[2].p_WB.z());
    return q;
  };
  EXPECT_THAT(
      starts("[initial.joints]\nj = { position = 4.0, velocity = 3.0 "
             "}\n"),
      ::testing::ElementsAre(4.0, -7.5, -0.75, ::testing::DoubleEq(-6.0),
                             ::testing::DoubleEq(-0.75)));
  EXPECT_THAT(starts("[initial.joints]\nl = { position = 0.25 }\n"),
              ::testing::ElementsAre(-1.0, 2.5, 0.25, 0.0, 0.25));
  EXPECT_THAT(starts(""), ::testing::ElementsAre(0.0, 0.5, 0.05, 0.0, 0.05));
}

}  // namespace
}  // namespace limber::scene::coupler_assembly_test
