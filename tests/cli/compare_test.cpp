// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/command.hpp"
#include "cli/shell.hpp"
#include "places.hpp"

namespace limber::test::compare_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// The report's beam, pushed at its end for 10 ms in its own axes.
struct Push {
  double duration = 0.02;  ///< [s]
  double step = 2e-4;      ///< [s]
  std::string integrator = "generalized-alpha";
  std::string more;
};

void write_push(const Workspace& place, const Push& push = {}) {
  place.write(
      "push.toml",
      fmt::format("robot = '" LIMBER_SOURCE_DIR
                  "/models/beam.urdf'\n[time]\nduration = {}\nstep = {}\n"
                  "output_interval = 0.002\nintegrator = '{}'\n"
                  "[output]\npictures = false\n"
                  "[[load]]\nname = 'push'\nlink = 'beam'\ngroup = 'tip'\n"
                  "force = [1e3, 5e2, 0.0]\nframe = 'body'\n"
                  "time = {{ kind = 'pulse', shape = 'half-sine', start = 0, "
                  "duration = 0.01 }}\n"
                  "[[probe]]\nname = 'p'\nlink = 'beam'\nnode = 1\n{}",
                  push.duration, push.step, push.integrator, push.more));
}

json compare(const Workspace& place, const std::string& arguments) {
  const CommandResult result =
      place.limber("compare push.toml --repeat 1 --out o --json " + arguments);
  EXPECT_EQ(result.status, 0) << result.errors;
  return json::parse(result.out, nullptr, false);
}

double error_of(const json& run, const std::string& field) {
  return run["error"][field]["relative"].get<double>();
}

// Errors of steps are of third order: a tenth takes 10^(1/3) = 2.15 times as
// many, where nothing else bounds them.
TEST(Compare, ReferenceOfATolerantScenarioStepsToATenthOfIt) {
  const Workspace place;
  write_push(place);
  const auto compare = [&](const std::string& more) {
    const CommandResult result = place.limber(
        "compare push.toml --fidelity coupled --repeat 1 --json --out o "
        "--unset time.step " +
        more);
    EXPECT_EQ(result.status, 0) << result.errors;
    const json report = json::parse(result.out);
    EXPECT_TRUE(report["reference"]["step"].is_null());
    EXPECT_EQ(report["reference"]["tolerance_share"], 0.1);
    return report["reference"]["steps"].get<double>() /
           report["runs"][0]["steps"].get<double>();
  };
  EXPECT_GE(compare(""), 1.0);
  // A second-order scheme's error goes with the square of its steps.
  EXPECT_NEAR(compare("--set time.tolerance=1e-10"), std::sqrt(10.0), 0.25);
}

TEST(Compare, ErrorsOfModesInClosedFormFallWithTheirNumber) {
  const Workspace place;
  write_push(place);
  const json found = compare(place,
                             "--fidelity uncoupled --modes 2,6,20 --reference "
                             "uncoupled --reference-modes 60");
  ASSERT_EQ(found["runs"].size(), 3U);
  double last = 1.0;
  for (const json& run : found["runs"]) {
    const double error = error_of(run, "deformation");
    EXPECT_LT(error, 0.7 * last) << run["name"];
    EXPECT_LT(error_of(run, "displacement"), error);
    last = error;
  }
}

TEST(Compare, ErrorsOfTheStepFallWithItsSquare) {
  const Workspace place;
  write_push(place);
  const json found = compare(place,
                             "--fidelity coupled --modes 2 --step 2e-4,1e-4 "
                             "--reference coupled --reference-step 1e-5");
  ASSERT_EQ(found["runs"].size(), 2U);
  const double order = std::log2(error_of(found["runs"][0], "deformation") /
                                 error_of(found["runs"][1], "deformation"));
  EXPECT_NEAR(order, 2.0, 0.1);
}

TEST(Compare, TakesNoWholeMeshForItsReferenceUnlessAskedAndSaysSo) {
  const Workspace place;
  write_push(place);
  const CommandResult text =
      place.limber("compare push.toml --repeat 1 --out o --fidelity rigid");
  ASSERT_EQ(text.status, 0) << text.errors;
  constexpr auto kNote = "The reference is the costliest reduced level";
  EXPECT_THAT(text.out, HasSubstr(kNote));
  EXPECT_THAT(text.errors, HasSubstr(kNote));  // before the first run
  const json found = compare(place, "--fidelity rigid");
  EXPECT_EQ(found["reference"]["fidelity"], "coupled");
  EXPECT_THAT(found["reference"]["note"].get<std::string>(),
              HasSubstr("--reference full"));
  const json asked = compare(place, "--fidelity rigid --reference coupled");
  EXPECT_FALSE(asked["reference"].contains("note"));
}

// Of a command that runs beside the test.
bool says(const Workspace& place, const std::string& words) {
  const auto file = place.folder() / "stderr2.txt";
  return std::filesystem::exists(file) &&
         read_text(file).find(words) != std::string::npos;
}

// Killed by the test: the checked output appears in its first seconds, also in
// a pipe.
TEST(Compare, SaysHowLongItWillTakeBeforeItTakesLong) {
  const Workspace place;
  write_push(place, {100.0, 2e-6, "generalized-alpha", ""});
  for (const std::string command :
       {"compare long.toml --fidelity rigid", "run long.toml"}) {
    std::filesystem::rename(place.folder() / "push.toml",
                            place.folder() / "long.toml");
    RunningCommand running(place, command + " --out o");
    for (int i = 0;
         i < 100 && !says(place, "remaining, estimated from its first"); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
    running.send(SIGTERM);
    const CommandResult result = running.wait();
    EXPECT_THAT(result.errors, HasSubstr("remaining, estimated from its first"))
        << command;
    std::filesystem::rename(place.folder() / "long.toml",
                            place.folder() / "push.toml");
  }
}

TEST(Compare, StepsTheReferenceExplicitlyWhereAsked) {
  const Workspace place;
  write_push(place);
  const json found = compare(place,
                             "--fidelity coupled --modes 2 --reference coupled "
                             "--reference-integrator runge-kutta-4");
  EXPECT_EQ(found["reference"]["integrator"], "runge-kutta-4");
  EXPECT_EQ(found["reference"]["newton_iterations"], 0);
  EXPECT_EQ(found["runs"][0]["integrator"], nullptr);
  EXPECT_GT(found["runs"][0]["newton_iterations"], 0);
}

// One run alone meets the tolerance: which is cheaper is not for a test to say.
TEST(Compare, WritesTheChoiceAsAScenarioThatRuns) {
  const Workspace place;
  write_push(place);
  const json found = compare(
      place,
      "--fidelity rigid,coupled --modes 2 --step 1e-4 --reference coupled "
      "--reference-modes 10 --tolerance 30%");
  const std::string name = found["chosen"]["run"];
  EXPECT_EQ(name, "coupled, 2 eigenmodes, 0.0001 s");
  EXPECT_LE(found["chosen"]["error"].get<double>(), 0.3);
  const CommandResult run =
      place.limber("run o/chosen.toml --out chosen --json");
  ASSERT_EQ(run.status, 0) << run.errors;
  const json summary = json::parse(run.out, nullptr, false);
  EXPECT_EQ(summary["modes"], 2);
  EXPECT_EQ(summary["steps"], 200);
}

TEST(Compare, EndsWithStatus3AndTheClosestWhenNothingMeetsTheTolerance) {
  const Workspace place;
  write_push(place);
  const std::string earlier =
      "compare push.toml --fidelity coupled --modes 2 --reference coupled "
      "--reference-modes 10 --tolerance 30% --repeat 1 --out o";
  ASSERT_EQ(place.limber(earlier).status, 0);
  ASSERT_TRUE(std::filesystem::exists(place.folder() / "o/chosen.toml"));
  const CommandResult result = place.limber(
      "compare push.toml --fidelity rigid --reference coupled --tolerance 1% "
      "--repeat 1 --out o");
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.errors, HasSubstr("no run meets the tolerance of 1 %"));
  EXPECT_THAT(result.errors,
              HasSubstr("'rigid' comes closest with an error of 100 %"));
  EXPECT_THAT(result.out, HasSubstr("deformation"));
  EXPECT_FALSE(std::filesystem::exists(place.folder() / "o/chosen.toml"));
  EXPECT_TRUE(std::filesystem::exists(place.folder() / "o/comparison.json"));
}

TEST(Compare, TabulatesARunThatStopsAndGoesOn) {
  const Workspace place;
  // Explicit steps too long for the tenth mode to be divided, or short enough.
  write_push(place, {2.0, 1e-4, "runge-kutta-4", ""});
  const json found =
      compare(place,
              "--fidelity coupled,rigid --reference coupled --step 0.5 "
              "--reference-step 2e-4");
  ASSERT_EQ(found["runs"].size(), 2U);
  EXPECT_EQ(found["runs"][0]["completed"], false);
  EXPECT_THAT(found["runs"][0]["stopped"].get<std::string>(),
              HasSubstr("t = "));
  EXPECT_FALSE(found["runs"][0].contains("error"));
  EXPECT_EQ(found["runs"][1]["completed"], true);
}

TEST(Compare, EndsWithTheErrorOfAReferenceThatStops) {
  const Workspace place;
  // Half of it, the reference's, is still too long to be divided.
  write_push(place, {2.0, 1.0, "runge-kutta-4", ""});
  const CommandResult result = place.limber(
      "compare push.toml --fidelity rigid --reference coupled --out o");
  EXPECT_EQ(result.status, 3);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.errors, HasSubstr("beam"));
}

TEST(Compare, KeepsRunsOfLevelsAndOthersWhereAsked) {
  const Workspace place;
  write_push(place);
  const auto has = [&](const std::string& name) {
    return std::filesystem::exists(place.folder() / "o" / name / "results.h5");
  };
  (void)compare(place,
                "--fidelity rigid --modes 2 --fidelity coupled "
                "--reference coupled");
  EXPECT_FALSE(has("coupled-2"));
  (void)compare(place, "--fidelity rigid,coupled --reference coupled");
  EXPECT_TRUE(has("rigid"));
  EXPECT_TRUE(has("coupled"));
  EXPECT_TRUE(has("reference"));
  (void)compare(place,
                "--fidelity coupled --modes 2 --sources all "
                "--reference coupled --keep");
  EXPECT_TRUE(has("coupled-2-all"));
}

TEST(Compare, RefusesBadAxesWithOneLine) {
  const Workspace place;
  write_push(place);
  const auto expect_refused = [&](const std::string& arguments,
                                  const std::string& culprit) {
    const CommandResult result =
        place.limber("compare push.toml --out o " + arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.errors, StartsWith("limber: error: ")) << arguments;
    EXPECT_THAT(result.errors, HasSubstr(culprit)) << arguments;
    EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1)
        << result.errors;
    EXPECT_FALSE(std::filesystem::exists(place.folder() / "o")) << arguments;
  };
  expect_refused("--fidelity rigd", "did you mean 'rigid'");
  expect_refused("--modes 4,-1", "--modes");
  expect_refused("--modes 4,ten", "--modes");
  expect_refused("--step 0", "--step");
  expect_refused("--step 1e-3,nan", "--step");
  expect_refused("--step 1e-3,", "--step: '1e-3,' has an empty value");
  expect_refused("--fidelity rigid,,coupled", "has an empty value");
  expect_refused("--sources load", "did you mean 'loads'");
  expect_refused("--tolerance 1", "is 100 %");
  expect_refused("--tolerance 1% --measure displaced", "measure");
  expect_refused("--repeat 0", "--repeat");
  expect_refused("--reference coupled --reference-step 1", "--reference-step");
  expect_refused("--reference-integrator runge-kuta-4", "did you mean");
  expect_refused("--fidelity rigid --modes 3", "no level");
}

}  // namespace
}  // namespace limber::test::compare_test
