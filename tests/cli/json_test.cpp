// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "places.hpp"

namespace limber::test::json_test {
namespace {

using nlohmann::json;

const std::string kBeam = LIMBER_SOURCE_DIR "/meshes/beam579.msh";
const std::string kExample = LIMBER_SOURCE_DIR "/examples/report_beam.toml";

/// Standard output, which must be one JSON object and nothing else.
json parse(const CommandResult& result) {
  EXPECT_EQ(result.status, 0) << result.errors;
  json object = json::parse(result.out, nullptr, false);
  EXPECT_TRUE(object.is_object()) << result.out;
  return object;
}

void expect_keys(const json& object, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) {
    EXPECT_TRUE(object.contains(key)) << key << " is not in " << object.dump(2);
  }
}

TEST(Json, OfModesHasThePromisedKeys) {
  const Workspace place;
  const json modes =
      parse(place.limber("modes '" + kBeam +
                         "' --youngs-modulus 200e9 --poisson-ratio 0 "
                         "--density 8000 --count 3 --json"));
  expect_keys(modes,
              {"nodes", "elements", "boundary_nodes", "mass", "center_of_mass",
               "inertia", "eigenvalues", "frequencies_hz"});
  EXPECT_EQ(modes["nodes"], 579);
  EXPECT_EQ(modes["elements"], 254);
  EXPECT_EQ(modes["boundary_nodes"], 426);
  EXPECT_NEAR(modes["mass"].get<double>(), 40000.0, 1e-6);
  EXPECT_NEAR(modes["center_of_mass"][2].get<double>(), 2.5, 1e-9);
  // A box: m (a^2 + b^2) / 12.
  EXPECT_NEAR(modes["inertia"][0][0].get<double>(), 40000.0 * 26.0 / 12.0,
              1e-5);
  EXPECT_EQ(modes["eigenvalues"].size(), 3U);
  EXPECT_EQ(modes["frequencies_hz"].size(), 3U);
}

TEST(Json, OfRunHasThePromisedKeysAndLeavesResults) {
  const Workspace place;
  const json run =
      parse(place.limber("run '" + kExample + "' --out results --json"));
  expect_keys(run, {"steps", "newton_iterations", "seconds_offline",
                    "seconds_online", "energy", "probes"});
  expect_keys(run["energy"], {"initial", "final", "dissipated", "work", "drift",
                              "throughput", "relative_drift"});
  expect_keys(run["probes"]["A.ux"], {"final", "peak", "unit"});
  EXPECT_EQ(run["steps"], 12500);
  for (const char* name : {"summary.json", "probes.csv", "results.h5"}) {
    EXPECT_TRUE(std::filesystem::exists(place.folder() / "results" / name))
        << name;
  }
  const json kept =
      json::parse(read_text(place.folder() / "results" / "summary.json"));
  EXPECT_EQ(kept["probes"], run["probes"]);
}

TEST(Json, OfInfoHasTheToleranceOrTheStepOfAScenario) {
  const Workspace place;
  const auto info = [&](const std::string& time) {
    place.write("s.toml", "robot = 'r.urdf'\n[time]\nduration = 2.0\n" + time);
    return parse(place.limber("info s.toml --json"));
  };
  const json fixed = info("step = 0.1\n");
  EXPECT_EQ(fixed["step"], 0.1);
  EXPECT_FALSE(fixed.contains("tolerance"));
  const json chosen = info("");
  EXPECT_FALSE(chosen.contains("step"));
  EXPECT_EQ(chosen["tolerance"], "1e-4 of the smallest group's largest body");
  const json given = info("tolerance = 1e-5\n");
  EXPECT_FALSE(given.contains("step"));
  EXPECT_EQ(given["tolerance"], 1e-5);
  const json bounded = info("tolerance = 1e-5\nstep = 0.1\n");
  EXPECT_EQ(bounded["step"], 0.1);
  EXPECT_EQ(bounded["tolerance"], 1e-5);
}

TEST(Json, OfCompareTabulatesErrorsAndCosts) {
  const Workspace place;
  const json compare = parse(
      place.limber("compare '" + kExample +
                   "' --fidelity rigid,coupled --reference coupled --step 1e-3 "
                   "--repeat 1 --out results --json"));
  expect_keys(compare["reference"], {"name", "step", "online", "energy_drift"});
  EXPECT_EQ(compare["reference"]["fidelity"], "coupled");
  EXPECT_EQ(compare["reference"]["step"], 5e-4);
  EXPECT_EQ(compare["reference"]["difference"]["B.ux"]["rms"], 0.0);
  ASSERT_EQ(compare["runs"].size(), 2U);
  const json& rigid = compare["runs"][0];
  expect_keys(rigid, {"name", "fidelity", "completed", "modes", "steps",
                      "online", "times_cheaper", "seconds_offline",
                      "energy_drift", "error", "bodies", "difference"});
  EXPECT_EQ(rigid["steps"], 500);
  EXPECT_EQ(rigid["repeats"], 1);
  EXPECT_GT(rigid["difference"]["B.ux"]["rms"].get<double>(), 0.0);
  // Nothing deforms: all of the reference's deformation is missing.
  EXPECT_NEAR(rigid["error"]["deformation"]["relative"].get<double>(), 1.0,
              1e-12);
  expect_keys(rigid["bodies"]["beam"],
              {"displacement", "rigid", "deformation"});
}

TEST(Json, OfInfoTellsTheKind) {
  const Workspace place;
  const json mesh = parse(place.limber("info '" + kBeam + "' --json"));
  EXPECT_EQ(mesh["kind"], "mesh");
  EXPECT_EQ(mesh["nodes"], 579);
  EXPECT_EQ(parse(place.limber("info '" + kExample + "' --json"))["kind"],
            "scenario");
  parse(place.limber("run '" + kExample + "' --out results --json"));
  const json results = parse(place.limber("info results/results.h5 --json"));
  EXPECT_EQ(results["kind"], "results");
  EXPECT_EQ(results["outputs"], 501);
  EXPECT_EQ(results["end"], 0.5);
  EXPECT_EQ(results["bodies"], json({"beam"}));
}

TEST(Json, OfInfoListsARobotsCouplers) {
  const Workspace place;
  place.write("robot.urdf",
              "<robot name='r'><link name='a'/><link name='b'/><link name='c'/>"
              "<joint name='j' type='continuous'><parent link='a'/>"
              "<child link='b'/></joint><joint name='k' type='floating'>"
              "<parent link='a'/><child link='c'/></joint>"
              "<loop name='o' kind='ball' from='b' to='c'/>"
              "<loop name='p' kind='prismatic' from='b' to='c'/>"
              "<gear name='g' joint='p' with='j' ratio='2'/>"
              "<latch name='l' reach='1' from='b' to='c'/>"
              "<tendon name='t'><via link='a'/><via link='c'/></tendon>"
              "</robot>");
  const json robot = parse(place.limber("info robot.urdf --json"));
  EXPECT_EQ(robot["loops"][0]["name"], "o");
  EXPECT_EQ(robot["loops"][0]["kind"], "ball");
  EXPECT_EQ(robot["loops"][1]["to"], "c");
  EXPECT_EQ(robot["gears"][0]["ratio"], 2.0);
  EXPECT_EQ(robot["latches"], json({"l"}));
  EXPECT_EQ(robot["tendons"], json({"t"}));
}

// Two folders that differ in such a byte keep different names.
TEST(Json, ShowsBytesOfFileNamesThatAreNotUtf8) {
  const Workspace place;
  place.write("r.urdf",
              "<robot name='r'><link name='a'><inertial><mass value='1'/>"
              "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>"
              "</inertial></link></robot>");
  for (const auto& [file, shown] : {std::pair{"\xfc.toml", "\\xfc.toml"},
                                    {"\xe4.toml", "\\xe4.toml"},
                                    {"\xc3\xa4.toml", "\xc3\xa4.toml"},
                                    {"\\xfc.toml", "\\xfc.toml"}}) {
    place.write(file,
                "robot = 'r.urdf'\n[time]\nduration = 0.1\nstep = 0.1\n"
                "[output]\npictures = false\n");
    const std::string run = std::string("run '") + file + "' --out o";
    EXPECT_EQ(parse(place.limber(run + " --json"))["scenario"], shown);
    EXPECT_EQ(
        json::parse(read_text(place.folder() / "o/summary.json"))["scenario"],
        shown);
  }
}

}  // namespace
}  // namespace limber::test::json_test
