// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/shell.hpp"
#include "places.hpp"

namespace limber::test::verify_test {
namespace {

using ::testing::HasSubstr;

const std::string kExample = LIMBER_SOURCE_DIR "/examples/report_beam.toml";

#ifdef LIMBER_HAS_REFERENCE

TEST(VerifyCommand, NamesTheToleranceOfAScenarioWithoutAStep) {
  const Workspace place;
  place.write("r.urdf",
              "<robot name='r'><link name='a'><inertial><mass value='2'/>"
              "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>"
              "</inertial></link></robot>");
  place.write("s.toml",
              "robot = 'r.urdf'\n[time]\nduration = 0.1\n[initial.base]\n"
              "velocity = [1, 0, 0]\n");
  const CommandResult result = place.limber("verify s.toml");
  ASSERT_EQ(result.status, 0) << result.errors;
  // 1e-4 of twice the radius of gyration, sqrt(2 * 3 / 2).
  EXPECT_THAT(result.out, HasSubstr("tolerance 0.000173 m"));
  const CommandResult fixed = place.limber("verify s.toml --step 0.01");
  EXPECT_THAT(fixed.out, HasSubstr("step 0.01 s"));
}

TEST(VerifyCommand, TellsDifferencesByBodyAndTheirOrder) {
  const Workspace place;
  const CommandResult result =
      place.limber("verify '" + kExample +
                   "' --duration 0.05 --step 1e-4 --refine 1 --json");
  ASSERT_EQ(result.status, 0) << result.errors;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_THAT(json["reference"].get<std::string>(), HasSubstr("Simbody"));
  EXPECT_EQ(json["joints"], "bushings");
  EXPECT_GT(json["motion"]["velocity"].get<double>(), 0.0);
  ASSERT_EQ(json["runs"].size(), 2U);
  EXPECT_FALSE(json["runs"][0].contains("order"));
  EXPECT_TRUE(json["runs"][1].contains("order"));
  EXPECT_DOUBLE_EQ(json["runs"][1]["step"].get<double>(), 0.5e-4);
  // A free body under known forces: round-off, most of it that of positions
  // metres from the world's origin that move by micrometres.
  EXPECT_LT(json["runs"][0]["relative"]["velocity"].get<double>(), 1e-12);
  EXPECT_LT(json["runs"][0]["difference"]["beam"]["position"].get<double>(),
            1e-12);
}

TEST(VerifyCommand, ShowsHowStiffenedJointsBecomeIdealAndDrawsIt) {
  const Workspace place;
  const CommandResult result = place.limber(
      "verify '" LIMBER_SOURCE_DIR
      "/examples/joint_chain.toml' --duration 0.1 --stiffen 10,100,1000 "
      "--out shown --json");
  ASSERT_EQ(result.status, 0) << result.errors;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["joints"], "ideal");
  ASSERT_EQ(json["stiffened"].size(), 3U);
  EXPECT_EQ(json["stiffened"][1]["factor"], 100.0);
  EXPECT_NEAR(json["stiffened"][2]["order"].get<double>(), 1.0, 0.05);
  EXPECT_EQ(json["first_order"], nlohmann::json::parse("[10.0, 1000.0]"));
  EXPECT_FALSE(json.contains("floor"));
  EXPECT_EQ(nlohmann::json::parse(
                read_text(place.folder() / "shown/verification.json")),
            json);
  EXPECT_THAT(read_text(place.folder() / "shown/stiffness.png"),
              ::testing::StartsWith("\x89PNG"));
}

// The program that links Simbody is not beside it.
TEST(VerifyCommand, SaysWhichProgramIsMissing) {
  const Workspace place;
  std::filesystem::copy_file(LIMBER_COMMAND, place.folder() / "limber");
  EXPECT_EQ(run_shell(place, "./limber --version").status, 0);
  const CommandResult result =
      run_shell(place, "./limber verify '" + kExample + "'");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(
      result.errors,
      HasSubstr("the verifier 'limber-verify' was not found; looked for "));
}

// Its folder is there once it listens to signals.
TEST(VerifyCommand, IsOneProcessThatSignalsReach) {
  const Workspace place;
  RunningCommand command(place, "verify --out o '" LIMBER_SOURCE_DIR
                                "/examples/pendulum_chain.toml'");
  ASSERT_TRUE(wait_for(place, "o"));
  const auto program =
      std::filesystem::path("/proc") / std::to_string(command.id()) / "exe";
  EXPECT_EQ(std::filesystem::read_symlink(program).filename(), "limber-verify");
  command.send(SIGTERM);
  EXPECT_EQ(command.wait().status, 143);
}

TEST(VerifyCommand, RefusesUnknownWords) {
  const Workspace place;
  for (const char* words :
       {"--joints welded", "--integrator leapfrog", "--accuracy 2", "--step -1",
        "--refine x", "--stiffen 1", "--stiffen 10,1", "--stiffen 0,1",
        "--stiffen 1,10 --joints bushings"}) {
    const CommandResult result =
        place.limber("verify '" + kExample + "' " + words);
    EXPECT_EQ(result.status, 2) << words;
    EXPECT_THAT(result.errors, HasSubstr("limber: error: ")) << words;
  }
}

#else

TEST(VerifyCommand, SaysThatItWasBuiltWithoutSimbody) {
  const Workspace place;
  const CommandResult result = place.limber("verify '" + kExample + "'");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, HasSubstr("LIMBER_REFERENCE"));
}

#endif

}  // namespace
}  // namespace limber::test::verify_test
