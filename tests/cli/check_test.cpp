// SPDX-License-Identifier: BSD-3-Clause
// limber check: what is known before a run.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cli/command.hpp"

namespace limber::test::check_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const char* const kSled = R"(<robot name='r'><link name='world'/>
<link name='sled'><inertial><mass value='3'/><inertia ixx='0.1' iyy='0.1'
  izz='0.1' ixy='0' ixz='0' iyz='0'/></inertial></link>
<joint name='rail' type='prismatic'><parent link='world'/><child link='sled'/>
  <axis xyz='1 0 0'/><limit lower='-9' upper='9' effort='0' velocity='0'/>
</joint>
<coupler joint='rail' translational_stiffness='3e4'
  rotational_stiffness='4e3'/></robot>)";

std::string write_sled(const std::string& time) {
  return "robot = 'robot.urdf'\n[time]\n" + time +
         "\n[[load]]\nname = 'late'\nlink = 'sled'\nforce = [1, 0, 0]\n"
         "time = { kind = 'constant', from = 1001.0 }\n"
         "[[load]]\nname = 'pull'\nlink = 'sled'\nforce = [1, 0, 0]\n"
         "[output]\npictures = false\n";
}

json check_sled(const Workspace& place, const std::string& time) {
  place.write("robot.urdf", kSled);
  place.write("s.toml", write_sled(time));
  const CommandResult result = place.limber("check s.toml --json");
  EXPECT_EQ(result.status, 0) << result.errors;
  return json::parse(result.out);
}

// A million steps: a run would take far longer than the test.
TEST(Check, NamesWhatCannotAnswerWithoutARun) {
  const Workspace place;
  const json check = check_sled(
      place, "duration = 1000.0\nstep = 1e-3\noutput_interval = 0.1\n");
  EXPECT_EQ(check["mass"], 3.0);
  EXPECT_EQ(check["outputs"], 10001);
  const std::string silent = check["silent"].dump();
  EXPECT_THAT(silent, HasSubstr("load 'late'"));
  EXPECT_THAT(silent, Not(HasSubstr("load 'pull'")));
}

// sqrt(3e4 N/m / 3 kg) = 100 rad/s; sqrt(4e3 N m / 0.1 kg m^2) = 200 rad/s.
TEST(Check, FindsTheFrequencyOfAMassOnItsJoint) {
  const Workspace place;
  const json check =
      check_sled(place, "duration = 1.0\nstep = 1e-3\noutput_interval = 0.1\n");
  ASSERT_EQ(check["joints"].size(), 1U);
  const double fastest = 200.0 / (2.0 * std::numbers::pi);
  EXPECT_EQ(check["joints"][0]["name"], "rail");
  EXPECT_NEAR(check["joints"][0]["fastest_hz"].get<double>(), fastest,
              1e-9 * fastest);
  EXPECT_NEAR(check["frequencies_hz"].back().get<double>(), fastest,
              1e-9 * fastest);
}

// Central differences are stable while omega^2 h^2 + 4 c h <= 4, c = 2 zeta
// omega and zeta = 0.01 of a joint; a run uses 0.95 of that: a step of 0.1 s
// has 11 parts.
TEST(Check, TellsIntoHowManyPartsAnExplicitStepIsDivided) {
  const Workspace place;
  const json check = check_sled(place,
                                "duration = 1.0\nstep = 0.1\n"
                                "integrator = 'central-differences'\n");
  const double omega = 200.0;
  const double c = 2.0 * 0.01 * omega;
  EXPECT_NEAR(check["stable_step"].get<double>(),
              2.0 * (std::hypot(c, omega) - c) / (omega * omega), 1e-5);
  EXPECT_THAT(place.limber("check s.toml").out, HasSubstr("into 11 parts"));
}

TEST(Check, PredictsTheSizeOfResults) {
  const Workspace place;
  const json check = check_sled(
      place, "duration = 0.5\nstep = 1e-3\noutput_interval = 1e-3\n");
  ASSERT_EQ(place.limber("run s.toml --out o").status, 0);
  const auto size = static_cast<double>(
      std::filesystem::file_size(place.folder() / "o/results.h5"));
  EXPECT_NEAR(check["cost"]["results_bytes"].get<double>(), size, 0.15 * size);
}

TEST(Check, OfARunToAToleranceHasTheFactorOfItsPrediction) {
  const Workspace place;
  const json check = check_sled(
      place, "duration = 1e4\ntolerance = 1e-9\noutput_interval = 1e3\n");
  const json& cost = check["cost"];
  ASSERT_TRUE(cost["seconds"].is_number()) << cost;
  EXPECT_GT(cost["fraction_scouted"], 0.0);
  EXPECT_GE(cost["seconds_factor"], 2.0);
  EXPECT_THAT(place.limber("check s.toml").out,
              HasSubstr("within a factor of"));
}

/// An arm of 1 m that turns about the origin, and a ball of radius 0.1 m.
json check_reach(const Workspace& place, double distance) {
  place.write("arm.urdf",
              R"(<robot name='r'><link name='world'/><link name='arm'>
<inertial><origin xyz='0.5 0 0'/><mass value='1'/><inertia ixx='0.1' iyy='0.1'
  izz='0.1' ixy='0' ixz='0' iyz='0'/></inertial>
<collision><origin xyz='0.95 0 0'/><geometry><sphere radius='0.05'/></geometry>
</collision></link>
<joint name='hinge' type='continuous'><parent link='world'/>
  <child link='arm'/><axis xyz='0 0 1'/></joint></robot>)");
  place.write("s.toml",
              fmt::format("robot = 'arm.urdf'\n[time]\nduration = 0.1\n"
                          "step = 1e-3\n[[obstacle]]\nname = 'ball'\n"
                          "shape = 'sphere'\nradius = 0.1\n"
                          "position = [{}, 0, 0]\n[[contact]]\n"
                          "between = ['arm', 'ball']\nfriction = 0.1\n"
                          "restitution = 0.5\n",
                          distance));
  const CommandResult result = place.limber("check s.toml --json");
  EXPECT_EQ(result.status, 0) << result.errors;
  return json::parse(result.out);
}

TEST(Check, NamesAContactBeyondTheReachOfItsJoints) {
  const Workspace place;
  const json far = check_reach(place, 5.0);
  EXPECT_THAT(far["silent"].dump(),
              HasSubstr("contact 'arm/ball' cannot occur"));
  EXPECT_NEAR(far["contacts"][0]["gap"].get<double>(), 5.0 - 0.1 - 1.0, 1e-9);
  EXPECT_THAT(check_reach(place, 1.2)["silent"], IsEmpty());
  EXPECT_THAT(check_reach(place, -1.05)["silent"], IsEmpty());  // half a turn
}

TEST(Check, RefusesBadInput) {
  const Workspace place;
  EXPECT_EQ(place.limber("check gone.toml").status, 2);
  place.write("s.toml", "robot = 7");
  EXPECT_EQ(place.limber("check s.toml").status, 2);
  EXPECT_EQ(place.limber("check s.toml --fidelity rigd").status, 2);
}

}  // namespace
}  // namespace limber::test::check_test
