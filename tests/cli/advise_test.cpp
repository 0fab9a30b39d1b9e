// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "places.hpp"

namespace limber::test::advise_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const std::string kBeam = LIMBER_SOURCE_DIR "/examples/report_beam.toml";
const std::string kArm =
    LIMBER_SOURCE_DIR "/bench/trade/scenes/struck_finger.toml";

/// The report's beam, alone, spinning.
void write_spin(const Workspace& place, double omega,
                const std::string& more = "") {
  place.write("spin.toml",
              fmt::format("robot = '{}/models/beam.urdf'\n[time]\nduration = "
                          "0.1\nstep = 1e-4\n[initial.base]\nangular_velocity "
                          "= [{}, 0.0, 0.0]\n{}\n",
                          LIMBER_SOURCE_DIR, omega, more));
}

json parse(const CommandResult& result) {
  EXPECT_EQ(result.status, 0) << result.errors;
  return json::parse(result.out, nullptr, false);
}

// The report, section 6.1: SimpleRB was justified. Its 1 um is even more than
// all that 100 N do to 40 t of steel.
TEST(Advise, FindsTheReportsImpactNeedsNoCoupling) {
  const Workspace place;
  const json advice = parse(place.limber("advise '" + kBeam + "' --json"));
  ASSERT_EQ(advice["bodies"].size(), 1U);
  const json& beam = advice["bodies"][0];
  EXPECT_DOUBLE_EQ(beam["limits"]["displacement"].get<double>(), 1e-6);
  EXPECT_DOUBLE_EQ(beam["limits"]["linear_limit"].get<double>(), 0.05);
  EXPECT_LT(beam["left_out"]["uncoupled"].get<double>(), 1e-6);
  EXPECT_EQ(beam["recommended"], "rigid");
  // The report's figures for ten modes, section 5.4.
  const json& boundary = beam["boundary"]["report"];
  EXPECT_NEAR(boundary["displacement"].get<double>() / 1.19, 1.0, 0.005);
  EXPECT_NEAR(boundary["linear_limit"].get<double>() / 59570.0, 1.0, 0.005);
  EXPECT_LT(boundary["margin"].get<double>(), 1.0);
  // A limit of a nanometre requires more than SimpleRB.
  const json finer =
      parse(place.limber("advise '" + kBeam + "' --displacement 1e-9 --json"));
  EXPECT_EQ(finer["bodies"][0]["recommended"], "uncoupled");
  EXPECT_EQ(finer["fidelity_table"], "[fidelity]\ndefault = \"uncoupled\"\n");
}

TEST(Advise, RisesWithTheSpin) {
  for (const auto& [omega, level] :
       {std::pair{0.1, "rigid"}, {30.0, "coupled"}}) {
    const Workspace place;
    write_spin(place, omega);
    const json advice = parse(place.limber("advise spin.toml --json"));
    EXPECT_EQ(advice["bodies"][0]["recommended"], level) << omega;
  }
}

TEST(Advise, PrintsATableThatTheScenarioTakes) {
  const Workspace place;
  write_spin(place, 30.0);
  const CommandResult text = place.limber("advise spin.toml --out o");
  ASSERT_EQ(text.status, 0) << text.errors;
  EXPECT_THAT(text.out, HasSubstr("recommended  coupled: "));
  const std::size_t start = text.out.find("[fidelity]");
  ASSERT_NE(start, std::string::npos);
  write_spin(place, 30.0,
             text.out.substr(start, text.out.find("\n\n", start) - start));
  const json run = parse(place.limber("run spin.toml --json"));
  EXPECT_EQ(run["levels"][0]["used"], "coupled");
  EXPECT_TRUE(std::filesystem::exists(place.folder() / "o/advice.json"));
}

// `coupled` is 19 % off there (docs/theory/nonlinear.md).
TEST(Advise, CertifiesNoSpinUpAtLevelCoupled) {
  const Workspace place;
  const std::string scene = "'" LIMBER_SOURCE_DIR "/examples/spin_up.toml'";
  const json body = parse(place.limber(
      "advise " + scene + " --fidelity coupled --json"))["bodies"][0];
  EXPECT_EQ(body["recommended"], "nonlinear") << body.dump(2);
  EXPECT_EQ(body["justified"], false);
  EXPECT_GT(body["load_factor"]["tension"]["value"].get<double>(), 2.0);
  const json run = parse(place.limber(
      "run " + scene +
      " --fidelity coupled --set time.step=0.005 --set output.pictures=false "
      "--json"))["levels"][0];
  EXPECT_EQ(run["recommended"], "nonlinear") << run.dump(2);
  EXPECT_EQ(run["justified"], false);
}

TEST(Advise, KnowsEveryLinkOfAnArm) {
  const Workspace place;
  const json advice = parse(place.limber("advise '" + kArm + "' --json"));
  ASSERT_EQ(advice["bodies"].size(), 6U);
  for (const json& body : advice["bodies"]) {
    // The joints turn by tenths of a radian; the links bend by far more than
    // a ten-millionth of their length.
    EXPECT_NE(body["recommended"], "rigid") << body.dump(2);
    EXPECT_GT(body["peaks"]["omega"]["value"].get<double>(), 0.0);
    EXPECT_EQ(body["beyond_linear_range"], false);
  }
}

TEST(Advise, TakesItsLimitsFromTheScenarioUnlessTheCommandHasThem) {
  const Workspace place;
  write_spin(place, 0.1,
             "[advice]\ndisplacement = 1e-12\nlinear_limit = 0.5\nforce = "
             "7.0");
  const auto limits = [&](const std::string& options) {
    return parse(place.limber("advise spin.toml --json " +
                              options))["bodies"][0]["limits"];
  };
  EXPECT_EQ(
      limits(""),
      json({{"displacement", 1e-12}, {"linear_limit", 0.5}, {"force", 7.0}}));
  EXPECT_EQ(
      limits("--displacement 1e-3 --force-limit 8"),
      json({{"displacement", 1e-3}, {"linear_limit", 0.5}, {"force", 8.0}}));
}

// Rigid links have no stress: its probes are left out of the first run.
TEST(Advise, TakesAScenarioWithProbesOfStress) {
  const Workspace place;
  const json advice = parse(place.limber("advise '" LIMBER_SOURCE_DIR
                                         "/examples/beam_stress.toml' --json"));
  ASSERT_EQ(advice["bodies"].size(), 1U);
  EXPECT_FALSE(advice["bodies"][0].contains("doubt"));
}

// What the advised level then deforms by lies within the twofold of a sudden
// load that the advice allows for.
TEST(Advise, AgreesWithARunAtTheLevelThatItAdvises) {
  for (const char* scene : {"beam_stress", "four_bar"}) {
    const Workspace place;
    const std::string file = fmt::format(
        "'{}/examples/{}.toml' --set "
        "time.duration=0.05",
        LIMBER_SOURCE_DIR, scene);
    const json before = parse(place.limber("advise " + file + " --json"));
    const json after = parse(place.limber("run " + file +
                                          " --fidelity coupled --json --set "
                                          "output.pictures=false"));
    for (std::size_t b = 0; b < before["bodies"].size(); ++b) {
      const auto peak = [&](const json& body) {
        return body["peaks"]["deformation"]["value"].get<double>();
      };
      const double advised = peak(before["bodies"][b]);
      const double found = peak(after["levels"][b]);
      EXPECT_LE(found, 1.01 * advised) << scene;
      EXPECT_GE(found, 0.2 * advised) << scene;
    }
  }
}

TEST(Advise, StatesThatItCannotTellAfterImpacts) {
  const Workspace place;
  const json body =
      parse(place.limber("advise '" LIMBER_SOURCE_DIR
                         "/examples/ball_on_link.toml' --json"))["bodies"][0];
  EXPECT_THAT(body["doubt"].get<std::string>(),
              HasSubstr("these figures may not apply"));
}

TEST(Advise, RefusesBadInput) {
  const Workspace place;
  const auto refuses = [&](const std::string& arguments,
                           const std::string& culprit) {
    const CommandResult result = place.limber("advise " + arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.errors, HasSubstr(culprit));
  };
  refuses("gone.toml", "gone.toml");
  refuses("'" + kBeam + "' --displacement -1", "--displacement");
  refuses("'" + kBeam + "' --linear-limit 0", "--linear-limit");
  refuses("'" + kBeam + "' --force-limit inf", "--force-limit");
  refuses("'" + kBeam + "' --fidelity rigd", "did you mean 'rigid'");
  write_spin(place, 1.0, "[advice]\ndisplacment = 1e-6");
  refuses("spin.toml", "displacment");
  write_spin(place, 1.0, "[advice]\nforce = -1.0");
  refuses("spin.toml", "force");
  place.write("ball.urdf",
              "<robot name='r'><link name='b'><inertial><mass value='1'/>"
              "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>"
              "</inertial></link></robot>");
  place.write("ball.toml",
              "robot='ball.urdf'\n[time]\nduration=0.1\nstep=0.01\n");
  refuses("ball.toml", "no link is flexible");
}

TEST(Run, WarnsOfALevelThatLeavesTooMuchOut) {
  const Workspace place;
  write_spin(place, 30.0);
  const CommandResult simple =
      place.limber("run spin.toml --fidelity uncoupled --json");
  EXPECT_THAT(simple.errors,
              HasSubstr("link 'beam' was uncoupled; coupled is needed"));
  const json level = parse(simple)["levels"][0];
  EXPECT_EQ(level["used"], "uncoupled");
  EXPECT_EQ(level["recommended"], "coupled");
  EXPECT_EQ(level["justified"], false);
  const json rigid =
      parse(place.limber("run spin.toml --fidelity rigid --json"))["levels"][0];
  EXPECT_EQ(rigid["recommended"], "coupled");
}

TEST(Run, HintsAtALevelThatIsMoreThanNeeded) {
  const Workspace place;
  write_spin(place, 0.1);
  const CommandResult run = place.limber("run spin.toml --json");
  EXPECT_EQ(run.errors, "");
  const json level = parse(run)["levels"][0];
  EXPECT_EQ(level["justified"], true);
  EXPECT_EQ(level["more_than_needed"], true);
  EXPECT_EQ(level["recommended"], "rigid");
}

TEST(Run, WarnsBeyondTheLinearRange) {
  const Workspace place;
  write_spin(place, 30.0, "[advice]\nlinear_limit = 1e-6");
  const CommandResult run = place.limber("run spin.toml --json");
  EXPECT_THAT(run.errors, HasSubstr("beyond the linear limit"));
  EXPECT_EQ(parse(run)["levels"][0]["justified"], false);
}

}  // namespace
}  // namespace limber::test::advise_test
