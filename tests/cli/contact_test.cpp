// SPDX-License-Identifier: BSD-3-Clause
// Impacts as scenarios ask for them and as the command reports them.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "cli/command.hpp"
#include "places.hpp"

namespace limber::test::contact_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

/// The ball of examples/ball_on_link.toml, R = 10 mm at 1 m/s, on the bar.
void write_ball(const Workspace& place, const std::string& more,
                const std::string& contact = "",
                const std::string& robot = LIMBER_SOURCE_DIR
                "/models/struck_bar.urdf") {
  place.write(
      "ball.toml",
      "robot = '" + robot +
          "'\n[output]\npictures = false\n"
          "[[projectile]]\nname = 'ball'\nradius = 0.01\ndensity = 7850\n"
          "position = [0.0, 0.0, 0.01501]\nvelocity = [0.0, 0.0, -1.0]\n"
          "[[contact]]\nbetween = ['bar', 'ball']\n" +
          contact + more);
}

json run(const Workspace& place) {
  const CommandResult result = place.limber("run ball.toml --out o --json");
  EXPECT_EQ(result.status, 0) << result.errors;
  return json::parse(result.out, nullptr, false);
}

constexpr const char* kFine =
    "[time]\nduration = 2e-4\nstep = 2e-7\noutput_interval = 1e-5\n";

// Finite elements of the whole bar, graded to 0.16 mm under the ball, with
// contact at nodes: 1692.6 N, 49.20 us, 0.04368 N s.
TEST(BallOnLink, IsStruckAsWholeFiniteElementsSay) {
  const Workspace place;
  write_ball(place, std::string(kFine) + "[basis]\neigenmodes = 40\n");
  const json contacts = run(place)["contacts"];
  ASSERT_EQ(contacts.size(), 1U);
  const json& impact = contacts[0];
  EXPECT_EQ(impact["between"], (json{"bar", "ball"}));
  EXPECT_EQ(impact["touches"], 1);
  EXPECT_NEAR(impact["peak_force"].get<double>() / 1692.6, 1.0, 0.01);
  EXPECT_NEAR(impact["duration"].get<double>() / 49.20e-6, 1.0, 0.02);
  EXPECT_NEAR(impact["impulse"].get<double>() / 0.04368, 1.0, 0.01);
  // What the impulse does to two free bodies that do not rotate.
  const double mass = 7850.0 * 4.0 / 3.0 * std::numbers::pi * 1e-6;
  const double reduced = 1.0 / (1.0 / mass + 1.0 / (7850.0 * 4e-5));
  EXPECT_NEAR(impact["restitution"].get<double>(),
              impact["impulse"].get<double>() / reduced - 1.0, 2e-3);
}

// The table refines its peaks between steps as probes do theirs: steps of a
// fifteenth of the impact, and of an eightieth.
TEST(BallOnLink, HasOnePeakForceInTableAndProbe) {
  std::vector<double> peaks;
  for (const double step : {3.2e-6, 6e-7}) {
    const Workspace place;
    write_ball(place,
               fmt::format("[time]\nduration = 1e-4\nstep = {:g}\n"
                           "output_interval = 5e-5\n[fidelity]\ndefault = "
                           "'rigid'\n[[probe]]\nname = 'hit'\ncontact = "
                           "['bar', 'ball']\nquantity = 'normal_force'\n",
                           step));
    const json summary = run(place);
    const json& impact = summary["contacts"][0];
    const json& probe = summary["probes"]["hit.normal_force"];
    peaks.push_back(impact["peak_force"].get<double>());
    EXPECT_NEAR(peaks.back() / probe["peak"].get<double>(), 1.0, 2e-3);
    EXPECT_NEAR(impact["peak_time"].get<double>(),
                probe["peak_time"].get<double>(), 0.1 * step);
  }
  EXPECT_NEAR(peaks[0] / peaks[1], 1.0, 5e-3);
}

// Two periods of the highest mode fit into the impact, of which a run would
// warn else, as it does with five modes; peak force as above.
TEST(BallOnLink, HasAutomaticModesThatAnswerTheImpact) {
  const Workspace place;
  place.write("bar.urdf",
              "<robot name='struck_bar'><link name='bar'/><flexible link='bar'>"
              "<mesh file='" LIMBER_SOURCE_DIR
              "/meshes/struck_bar.geo'/><material youngs_modulus='210e9' "
              "poisson_ratio='0.3' density='7850'/><basis eigenmodes='auto'/>"
              "</flexible><contact link='bar' surface='top'/></robot>\n");
  write_ball(place, kFine, "", "bar.urdf");
  const json summary = run(place);
  const json& impact = summary["contacts"][0];
  EXPECT_NEAR(impact["peak_force"].get<double>() / 1692.6, 1.0, 0.02);
  EXPECT_THAT(summary["warnings"].dump(),
              ::testing::Not(HasSubstr("periods of which fit")));
  const int modes = summary["modes"].get<int>();
  EXPECT_GT(modes, 20);
  EXPECT_LT(modes, 40);
}

// Without modes: Hertz's closed form.
TEST(BallOnLink, OfARigidLinkIsHertzs) {
  const Workspace place;
  write_ball(place, std::string(kFine) + "[fidelity]\ndefault = 'rigid'\n");
  const json impact = run(place)["contacts"][0];
  const double mass = 7850.0 * 4.0 / 3.0 * std::numbers::pi * 1e-6;
  const double reduced = 1.0 / (1.0 / mass + 1.0 / (7850.0 * 4e-5));
  const double k = 4.0 / 3.0 * 210e9 / 0.91 * 0.1;
  const double depth = std::pow(1.25 * reduced / k, 0.4);
  EXPECT_NEAR(impact["peak_force"].get<double>() / (k * std::pow(depth, 1.5)),
              1.0, 5e-3);
  EXPECT_NEAR(impact["duration"].get<double>() / (2.9433 * depth), 1.0, 5e-3);
  EXPECT_NEAR(impact["restitution"].get<double>(), 1.0, 2e-3);
}

// The impact lasts half of such a step. What rings after it is damped, of which
// the run warns.
TEST(BallOnLink, IsStruckAlikeInStepsLongerThanTheImpact) {
  const Workspace place;
  write_ball(place, "[time]\nduration = 2e-3\nstep = 1e-4\n");
  const CommandResult result = place.limber("run ball.toml --out o --json");
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr("use shorter steps"));
  const json impact = json::parse(result.out)["contacts"][0];
  EXPECT_NEAR(impact["peak_force"].get<double>() / 1692.6, 1.0, 0.02);
  EXPECT_NEAR(impact["impulse"].get<double>() / 0.04368, 1.0, 0.01);
  EXPECT_NEAR(impact["duration"].get<double>() / 49.2e-6, 1.0, 0.02);
}

TEST(BallOnLink, TellsWhatItTakesForFrictionAndRestitution) {
  const Workspace place;
  write_ball(place, kFine);
  const CommandResult result = place.limber("run ball.toml --out o --json");
  EXPECT_THAT(result.errors, HasSubstr("restitution"));
  EXPECT_THAT(result.errors, HasSubstr("friction"));
}

TEST(BallOnLink, RefusesWrongValuesInOneErrorWithStatus2) {
  for (const auto& [value, words] :
       std::vector<std::pair<std::string, std::string>>{
           {"friction = -0.1\n", "friction"},
           {"restitution = 1.5\n", "restitution"},
           {"radius = 0.0\n", "radius"},
           {"stifness = 1e9\n", "stifness"}}) {
    const Workspace place;
    write_ball(place, kFine, value);
    const CommandResult result = place.limber("run ball.toml --out o");
    EXPECT_EQ(result.status, 2) << value;
    EXPECT_THAT(result.errors, HasSubstr(words)) << value;
  }
}

TEST(BallOnLink, RefusesWhatCannotTouchInOneErrorWithStatus2) {
  const Workspace place;
  write_ball(place, kFine);
  for (const auto& [option, words] :
       std::vector<std::pair<std::string, std::string>>{
           {"contact.0.between=[\"bar\",\"balll\"]",
            "'balll'; did you mean 'ball'"},
           {"contact.0.between=[\"bar\",\"finger_*\"]",
            "'finger_*' matches no link"},
           {"robot.contact.bar.surface=body",
            "contact group 'body' (dimension 3) has no faces"},
           {"robot.contact.bar.surface=tip", "'tip'"}}) {
    const CommandResult result =
        place.limber("run ball.toml --out o --set '" + option + "'");
    EXPECT_EQ(result.status, 2) << option;
    EXPECT_THAT(result.errors, HasSubstr(words)) << option;
  }
}

// What a comparison says of a run is what the run says itself.
TEST(BallOnLink, IsComparedOverLevels) {
  const Workspace place;
  write_ball(place, std::string(kFine) + "[basis]\neigenmodes = 20\n");
  const json alone = run(place)["contacts"][0];
  const CommandResult result = place.limber(
      "compare ball.toml --fidelity rigid,coupled --reference coupled "
      "--repeat 1 --out c --json");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json all = json::parse(result.out, nullptr, false);
  const json truth = all["reference"]["contacts"][0];
  const json rigid = all["runs"][0]["contacts"][0];
  const json coupled = all["runs"][1]["contacts"][0];
  EXPECT_FALSE(truth.contains("error"));
  for (const char* key : {"impulse", "peak_force", "duration"}) {
    EXPECT_EQ(coupled[key], alone[key]) << key;
    EXPECT_NEAR(rigid["error"][key].get<double>(),
                rigid[key].get<double>() / truth[key].get<double>() - 1.0,
                1e-12);
    EXPECT_LT(std::abs(coupled["error"][key].get<double>()), 0.01) << key;
  }
  EXPECT_EQ(coupled["restitution"], alone["restitution"]);
  // A bar that cannot bend takes more force.
  EXPECT_GT(rigid["error"]["peak_force"].get<double>(), 0.05);
  EXPECT_THAT(read_text(place.folder() / "c/comparison.json"),
              HasSubstr("restitution"));
  const CommandResult text = place.limber(
      "compare ball.toml --fidelity rigid --reference coupled --repeat 1 "
      "--out c");
  EXPECT_THAT(text.out, HasSubstr("impulse [N s]"));
}

// 40 modes of the bar end above two periods in the impact, 10 below.
TEST(BallOnLink, TellsIfItsBasisIsTooSmallForTheImpact) {
  for (const bool is_small : {true, false}) {
    const Workspace place;
    write_ball(place, std::string(kFine) + "[basis]\neigenmodes = " +
                          (is_small ? "10\n" : "40\n"));
    const CommandResult result = place.limber("run ball.toml --out o --json");
    ASSERT_EQ(result.status, 0) << result.errors;
    const auto words = HasSubstr("10 modes of body 'bar'");
    const std::string warnings =
        json::parse(result.out, nullptr, false)["warnings"].dump();
    if (is_small) {
      EXPECT_THAT(result.errors, words);
      EXPECT_THAT(warnings, words);
    } else {
      EXPECT_THAT(warnings, ::testing::Not(HasSubstr("modes of body")));
    }
    const CommandResult advice =
        place.limber("advise ball.toml --json --out a");
    ASSERT_EQ(advice.status, 0) << advice.errors;
    const json body = json::parse(advice.out, nullptr, false)["bodies"][0];
    EXPECT_EQ(body["impacts"][0]["contact"], "bar/ball");
    EXPECT_EQ(body["impacts"][0]["enough"], !is_small);
    EXPECT_GT(body["left_out"]["rigid"].get<double>(), 1e-5);  // it must bend
  }
}

// The bar of 200 x 20 mm in elements of 5 mm: 41 x 5 corners, 81 x 9 nodes.
TEST(BallOnLink, LeavesASurfaceInTheFileOfItsBody) {
  const Workspace place;
  write_ball(place, "[time]\nduration = 1e-6\nstep = 2e-7\n");
  const CommandResult result =
      place.limber("run ball.toml --out o --cache c --json");
  ASSERT_EQ(result.status, 0) << result.errors;
  json surfaces;
  for (const auto& entry :
       std::filesystem::directory_iterator(place.folder() / "c")) {
    if (entry.path().extension() != ".h5") continue;
    const CommandResult info =
        place.limber("info --json '" + entry.path().string() + "'");
    ASSERT_EQ(info.status, 0) << info.errors;
    surfaces = json::parse(info.out, nullptr, false)["contact_surfaces"];
  }
  ASSERT_EQ(surfaces.size(), 1U);
  EXPECT_EQ(surfaces[0]["name"], "top");
  EXPECT_EQ(surfaces[0]["nodes"], 81 * 9);
  EXPECT_EQ(surfaces[0]["faces"], 40 * 4 * 2);
  EXPECT_EQ(surfaces[0]["youngs_modulus"], 210e9);
  for (const json& radius : surfaces[0]["patch_radius"]) {
    EXPECT_NEAR(radius.get<double>(), 0.005, 1e-9);
  }
}

}  // namespace
}  // namespace limber::test::contact_test
