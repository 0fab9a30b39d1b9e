// SPDX-License-Identifier: BSD-3-Clause
// limber explain: what a run's record shows.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/shell.hpp"
#include "places.hpp"

namespace limber::test::explain_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

json explain(const Workspace& place) {
  const CommandResult result = place.limber("explain o --json");
  EXPECT_EQ(result.status, 0) << result.errors;
  return json::parse(result.out, nullptr, false);
}

double sum(const json& limits, const char* key) {
  double all = 0.0;
  for (const json& limit : limits) all += limit[key].get<double>();
  return all;
}

/// Falls 0.2 m onto a floor, in 0.202 s.
void run_ball(const Workspace& place, const std::string& more = "") {
  place.write(
      "ball.urdf",
      "<robot name='ball'><link name='ball'><inertial><mass value='0.26'/>"
      "<inertia ixx='4e-5' iyy='4e-5' izz='4e-5' ixy='0' ixz='0' iyz='0'/>"
      "</inertial><collision><geometry><sphere radius='0.02'/></geometry>"
      "</collision></link></robot>");
  place.write("s.toml",
              "robot = 'ball.urdf'\n[time]\nduration = 0.3\nstep = 1e-3\n"
              "output_interval = 0.01\n[gravity]\n"
              "acceleration = [0.0, 0.0, -9.81]\n[initial.base]\n"
              "position = [0.0, 0.0, 0.22]\n[[obstacle]]\nname = 'floor'\n"
              "shape = 'plane'\nnormal = [0, 0, 1]\nposition = [0, 0, 0]\n"
              "[[contact]]\nbetween = ['ball', 'floor']\nfriction = 0.0\n"
              "restitution = 0.8\n[output]\npictures = false\n");
  const CommandResult result = place.limber("run s.toml --out o " + more);
  ASSERT_EQ(result.status, 0) << result.errors;
}

TEST(Explain, TellsWhenABallStrikesAndWhatItsStepsServe) {
  const Workspace place;
  run_ball(place);
  const json found = explain(place);
  EXPECT_EQ(found["status"], "finished");
  const json& events = found["events"];
  ASSERT_EQ(events.size(), 2U);  // it touches and leaves
  EXPECT_EQ(events[0]["source"], "ball/floor");
  EXPECT_NEAR(events[0]["time"].get<double>(), std::sqrt(2.0 * 0.2 / 9.81),
              1e-6);
  EXPECT_GE(events[0]["iterations"], 1);
  EXPECT_NEAR(sum(found["limits"], "time"), 0.3, 1e-9);
  EXPECT_GT(found["limits_by_pair"]["ball/floor"], 10.0);
  // The kinetic energy of the fall goes into the contact, and 0.8^2 comes back,
  // by the powers at both ends of some twenty steps.
  ASSERT_FALSE(found["carried"].empty());
  const json& contact = found["carried"][0];
  const double energy = 0.26 * 9.81 * 0.2;
  EXPECT_EQ(contact["name"], "pair 'ball/floor'");
  EXPECT_NEAR(contact["in"].get<double>(), energy, 0.05 * energy);
  EXPECT_NEAR(contact["out"].get<double>(), 0.64 * energy, 0.05 * energy);
}

TEST(Explain, SharesTheTimeOfTheStepsAmongTheirParts) {
  const Workspace place;
  run_ball(place, "--set time.step=1e-5");
  const json found = explain(place);
  double parts = 0.0;
  for (const json& part : found["seconds_by_part"]) {
    EXPECT_GE(part, 0.0);
    parts += part.get<double>();
  }
  EXPECT_GT(parts, 0.0);
  EXPECT_EQ(found["limits_by_body"].size(), 0U);
  EXPECT_THAT(place.limber("explain o").out, HasSubstr("Newton"));
}

TEST(Explain, NamesTheBodyWhoseErrorLimitsTheSteps) {
  const Workspace place;
  run_ball(place, "--unset time.step --set time.tolerance=1e-7");
  const json found = explain(place);
  EXPECT_NEAR(sum(found["limits"], "time"), 0.3, 1e-9);
  EXPECT_EQ(sum(found["limits"], "count"), found["steps"]);
  EXPECT_LE(found["try"].size(), 3U);
}

// Explicit steps over a thousand times too long for the beam.
TEST(Explain, GivesTheCauseOfAFailedRun) {
  const Workspace place;
  place.write("s.toml",
              "robot = '" LIMBER_SOURCE_DIR
              "/models/beam.urdf'\n[time]\nduration = 2.0\nstep = 0.45\n"
              "integrator = 'runge-kutta-4'\noutput_interval = 0.1\n"
              "[output]\npictures = false\n[[load]]\nname = 'push'\n"
              "link = 'beam'\ngroup = 'tip'\nforce = [1e3, 0.0, 0.0]\n"
              "time = { kind = 'constant', from = 0.5 }\n");
  const CommandResult run = place.limber("run s.toml --out o");
  ASSERT_EQ(run.status, 3) << run.errors;
  const json found = explain(place);
  EXPECT_EQ(found["status"], "failed");
  EXPECT_THAT(run.errors, HasSubstr(found["cause"].get<std::string>()));
  EXPECT_NEAR(found["reached"].get<double>(), 0.5, 0.2);
  EXPECT_FALSE(found["try"].empty());
}

TEST(Explain, OffersToResumeAKilledRun) {
  const Workspace place;
  run_ball(place);
  fs::remove_all(place.folder() / "o");
  const CommandResult result = run_shell(
      place,
      "'" LIMBER_COMMAND
      "' run s.toml --set time.step=1e-7 --out o --checkpoint-interval 0 "
      ">run.txt 2>&1 & pid=$!; while kill -0 $pid 2>/dev/null && "
      "[ ! -e o/checkpoint.bin ]; do sleep 0.01; done; kill -9 $pid");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json found = explain(place);
  EXPECT_EQ(found["status"], "killed");
  EXPECT_THAT(found["try"].dump(), HasSubstr("--resume"));
}

void expect_refused(const Workspace& place, const std::string& folder,
                    const std::string& text) {
  const CommandResult result = place.limber("explain '" + folder + "'");
  EXPECT_EQ(result.status, 2) << folder;
  EXPECT_EQ(result.out, "") << folder;
  EXPECT_THAT(result.errors, HasSubstr(text)) << folder;
  EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1)
      << result.errors;
}

TEST(Explain, RefusesWhatIsNoRun) {
  const Workspace place;
  expect_refused(place, "gone", "not a folder");
  place.write("file", "text");
  expect_refused(place, "file", "not a folder");
  const auto make = [&](const std::string& folder, const std::string& file,
                        const std::string& text) {
    fs::create_directories(place.folder() / folder);
    place.write(folder + "/" + file, text);
  };
  make("odd \"*$", "notes.txt", "");
  expect_refused(place, "odd \"*$", "neither summary.json");
  make("study", "study.sqlite", "");
  expect_refused(place, "study", "belongs to a study");
  make("compare", "comparison.json", "{}");
  expect_refused(place, "compare", "belongs to a comparison");
  make("half", "summary.json", "{\"steps\": 3, ");
  expect_refused(place, "half", "its JSON is incomplete");
  make("list", "summary.json", "[]");
  expect_refused(place, "list", "damaged");
  make("static", "summary.json", "{\"scenario\": \"s\"}");
  expect_refused(place, "static", "not the summary of a run in time");
  make("old", "summary.json", "{\"steps\": \"three\"}");
  expect_refused(place, "old", "of another version");
  make("cut", "checkpoint.bin", "limber");
  expect_refused(place, "cut", "checkpoint");
  fs::create_directories(place.folder() / "nested/summary.json");
  expect_refused(place, "nested", "summary.json");
}

}  // namespace
}  // namespace limber::test::explain_test
