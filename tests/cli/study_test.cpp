// SPDX-License-Identifier: BSD-3-Clause
// Studies: the same numbers as single runs, however they were made.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/command.hpp"
#include "cli/shell.hpp"
#include "cli/sled_study.hpp"
#include "places.hpp"

namespace limber::test::study_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(AStudy, HasTheResponsesOfSingleRunsToTheBit) {
  (void)run("study.toml --out a --csv --jobs 2");
  std::ifstream table(place_.folder() / "a/study.csv");
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line,
            "run,force,stiffness,x,when,last,size,work,per_force,error,"
            "warnings");
  for (int i = 0; i < 12; ++i) {
    std::getline(table, line);
    std::vector<std::string> cells;
    for (std::size_t at = 0; at != std::string::npos;) {
      const std::size_t comma = line.find(',', at);
      cells.push_back(line.substr(at, comma - at));
      at = comma == std::string::npos ? comma : comma + 1;
    }
    ASSERT_GE(cells.size(), 11U);
    if (i % 4 != 0) continue;
    const CommandResult result = place_.limber(
        "run s.toml --out r --json --set load.push.force.0=" + cells[1] +
        " --set robot.spring.coil.stiffness=" + cells[2]);
    ASSERT_EQ(result.status, 0) << result.errors;
    const json summary = json::parse(result.out);
    const json& probe = summary["probes"]["sled.ux"];
    EXPECT_EQ(std::stod(cells[3]), probe["peak"].get<double>());
    EXPECT_EQ(std::stod(cells[4]), probe["peak_time"].get<double>());
    EXPECT_EQ(std::stod(cells[5]), probe["final"].get<double>());
    EXPECT_EQ(std::stod(cells[7]), summary["energy"]["work"].get<double>());
    EXPECT_EQ(std::stod(cells[8]), std::stod(cells[3]) / std::stod(cells[1]));
    const CommandResult again = place_.limber(
        fmt::format("run --from a/study.sqlite#{} --out f --json", i));
    ASSERT_EQ(again.status, 0) << again.errors;
    EXPECT_EQ(json::parse(again.out)["probes"], summary["probes"]);
  }
}

TEST_F(AStudy, GivesARunWhoseFactorsCanBeSetAnew) {
  (void)run("study.toml --out a --csv");
  const auto probes = [&](const std::string& options) {
    const CommandResult result = place_.limber("run --out r --json " + options);
    EXPECT_EQ(result.status, 0) << result.errors;
    return json::parse(result.out)["probes"];
  };
  const std::string anew =
      " --set load.push.force.0=7.5 --set robot.spring.coil.stiffness=33";
  EXPECT_EQ(probes("--from a/study.sqlite#1" + anew), probes("s.toml" + anew));
  EXPECT_NE(probes("--from a/study.sqlite#1" + anew),
            probes("--from a/study.sqlite#1"));
}

TEST_F(AStudy, HasTheSameTableWithAnyNumberOfJobs) {
  (void)run("study.toml --out a --csv --jobs 1");
  (void)run("study.toml --out b --csv --jobs 5");
  EXPECT_EQ(table("a"), table("b"));
}

TEST_F(AStudy, GoesOnAfterBeingKilledWithTheSameTable) {
  place_.write("study.toml", replace(kStudy, "samples = 12", "samples = 60"));
  (void)run("study.toml --out whole --csv");
  for (const double seconds : {0.05, 0.15, 0.1, 0.25}) {
    (void)run_shell(place_, fmt::format("timeout -s KILL {} '" LIMBER_COMMAND
                                        "' study study.toml --out a",
                                        seconds));
  }
  (void)run("study.toml --out a --csv");
  EXPECT_EQ(table("a"), table("whole"));
}

TEST_F(AStudy, EndsOnASignalWithAllThatIsDone) {
  place_.write("study.toml", replace(kStudy, "samples = 12", "samples = 5000"));
  RunningCommand study(place_, "study study.toml --out a");
  ASSERT_TRUE(wait_for(place_, "a/study.sqlite"));
  std::this_thread::sleep_for(std::chrono::seconds(1));
  study.send(SIGTERM);
  const CommandResult result = study.wait();
  EXPECT_EQ(result.status, 143);
  EXPECT_THAT(result.errors, HasSubstr("continues with the others"));
}

TEST_F(AStudy, IsNotGoneOnWithAnother) {
  (void)run("study.toml --out a");
  place_.write("study.toml", replace(kStudy, "seed = 5", "seed = 6"));
  expect_refused("study.toml --out a", "study, seed: 5 -> 6");
  place_.write("study.toml", kStudy);
  place_.write("s.toml", replace(kScenario, "step = 1e-3", "step = 2e-3"));
  expect_refused("study.toml --out a", "belong to another study");
  const CommandResult opened =
      place_.limber("run --from a/study.sqlite#3 --out f");
  EXPECT_EQ(opened.status, 2);
  EXPECT_THAT(opened.errors, HasSubstr("was made from another version of"));
}

TEST_F(AStudy, IsJoinedFromItsShards) {
  (void)run("study.toml --out whole --csv");
  for (int k = 1; k <= 3; ++k) {
    (void)run(fmt::format("study.toml --out parts --shard {}/3", k));
  }
  (void)run(
      "--collect parts/study-3-of-3.sqlite parts/study-1-of-3.sqlite "
      "parts/study-2-of-3.sqlite --out a --csv");
  EXPECT_EQ(table("a"), table("whole"));
  expect_refused(
      "--collect parts/study-1-of-3.sqlite whole/study.sqlite --out "
      "b",
      "shards have no runs in common");
  expect_refused("--collect parts/study-1-of-3.sqlite --out a",
                 "already exists");
  place_.write("other.toml", replace(kStudy, "seed = 5", "seed = 6"));
  (void)run("other.toml --out other --shard 2/3");
  expect_refused(
      "--collect parts/study-1-of-3.sqlite "
      "other/study-2-of-3.sqlite --out b",
      "belongs to another study");
}

TEST_F(AStudy, OfAnotherLayoutIsRefused) {
  (void)run("study.toml --out a");
  ASSERT_EQ(run_shell(place_,
                      "/usr/bin/python3 -c \"import sqlite3; "
                      "c = sqlite3.connect('a/study.sqlite'); c.execute("
                      "'UPDATE study SET value = 7 WHERE key = \\'layout\\''); "
                      "c.commit()\"")
                .status,
            0);
  expect_refused("study.toml --out a", "is of layout '7'; this Limber reads 2");
  expect_refused("--collect a/study.sqlite --out b", "is of layout '7'");
  EXPECT_EQ(place_.limber("run --from a/study.sqlite#1").status, 2);
}

TEST_F(AStudy, OpensARunAgainWithItsPage) {
  (void)run("study.toml --out a");
  const CommandResult result =
      place_.limber("run --from a/study.sqlite#3 --out f --view");
  if (result.status == 2 && result.errors.find("page") != std::string::npos) {
    GTEST_SKIP() << result.errors;  // a build without it
  }
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_TRUE(fs::exists(place_.folder() / "f/view.html"));
  EXPECT_TRUE(fs::exists(place_.folder() / "f/results.h5"));
}

TEST_F(AStudy, HasARowWithTheReasonForARunThatFails) {
  place_.write("study.toml", replace(replace(kStudy, "uniform = [-2.0, 2.0]",
                                             "choice = ['strong', 1.0]"),
                                     "12", "6"));
  const std::string out = run("study.toml --out a --csv --json");
  const json summary = json::parse(out);
  EXPECT_EQ(summary["done"], 6);
  EXPECT_GT(summary["failed"].get<int>(), 0);
  EXPECT_LT(summary["failed"].get<int>(), 6);
  EXPECT_THAT(table("a"), HasSubstr("load.push.force.0=strong"));
}

TEST_F(AStudy, ComparesLevelsAsAFactor) {
  place_.write("study.toml",
               "scenario = '" LIMBER_SOURCE_DIR
               "/examples/four_bar.toml'\nset = ['time.duration=0.02']\n"
               "[design]\nkind = 'grid'\n[[factor]]\nname = 'level'\npath = "
               "'fidelity'\nvalues = ['rigid', 'coupled']\n[[response]]\nname "
               "= 'modes'\nsummary = 'modes'\n");
  (void)run("study.toml --out a --csv");
  EXPECT_THAT(table("a"), HasSubstr("0,rigid,0,"));
  EXPECT_THAT(table("a"), Not(HasSubstr("1,coupled,0,")));
}

// In two columns with only one output besides the start, the difference is
// that of the final values.
TEST_F(AStudy, MeasuresWhatALevelChangesBySingleRuns) {
  const std::string settings =
      " --set time.duration=0.02 --set time.output_interval=0.02";
  place_.write("study.toml",
               "scenario = '" LIMBER_SOURCE_DIR
               "/examples/four_bar.toml'\nset = ['time.duration=0.02', "
               "'time.output_interval=0.02']\n[design]\nkind = 'grid'\n"
               "[[factor]]\nname = 'step'\npath = 'time.step'\n"
               "values = [1e-3, 5e-4]\n"
               "[[response]]\nname = 'own'\nprobe = 'crank.q'\n"
               "measure = 'final'\n"
               "[[response]]\nname = 'rigid'\nprobe = 'crank.q'\n"
               "measure = 'final'\nlevel = 'rigid'\n"
               "[[response]]\nname = 'off'\nprobe = 'crank.q'\n"
               "measure = 'difference'\nlevel = 'rigid'\n"
               "[[response]]\nname = 'none'\nprobe = 'crank.q'\n"
               "measure = 'difference'\nlevel = 'coupled'\n");
  (void)run("study.toml --out a --csv");
  const auto find_final = [&](const std::string& more) {
    const CommandResult result =
        place_.limber("run " LIMBER_SOURCE_DIR
                      "/examples/four_bar.toml --json --out r --set "
                      "time.step=5e-4" +
                      settings + more);
    EXPECT_EQ(result.status, 0) << result.errors;
    return json::parse(result.out)["probes"]["crank.q"]["final"].get<double>();
  };
  const double own = find_final(" --fidelity coupled");
  const double rigid = find_final(" --fidelity rigid");
  EXPECT_NE(own, rigid);
  EXPECT_THAT(table("a"), HasSubstr(fmt::format("1,0.0005,{},{},{},0,", own,
                                                rigid, std::abs(own - rigid))));
}

TEST_F(AStudy, TakesFiguresOfTheSummaryOrTellsThatTheyAreNotThere) {
  const std::string study =
      "scenario = '" LIMBER_SOURCE_DIR
      "/examples/four_bar.toml'\nset = ['time.duration=0.02']\n"
      "[design]\nkind = 'list'\n[[factor]]\nname = 'step'\npath = "
      "'time.step'\nvalues = [1e-3]\n[[response]]\nname = 'y'\nsummary = ";
  place_.write("study.toml", study + "'levels.rod.peaks.angle'\n");
  (void)run("study.toml --out a --csv");
  const CommandResult result = place_.limber(
      "run " LIMBER_SOURCE_DIR
      "/examples/four_bar.toml --set time.duration=0.02 --set time.step=1e-3 "
      "--json --out r");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json level = json::parse(result.out)["levels"][0];
  ASSERT_EQ(level["body"], "rod");
  EXPECT_THAT(table("a"),
              HasSubstr(fmt::format("0,0.001,{},",
                                    level["peaks"]["angle"].get<double>())));
  place_.write("study.toml", study + "'levels.rodd.peaks.angle'\n");
  EXPECT_THAT(place_.limber("study study.toml --out b --csv").errors,
              HasSubstr("response 'y' has no value in any run"));
  EXPECT_THAT(table("b"), HasSubstr("0,0.001,,,"));
  place_.write("study.toml", study + "'events.7.time'\n");
  (void)run("study.toml --out c --csv");
  EXPECT_THAT(table("c"), HasSubstr("0,0.001,,,"));
}

// Its names are checked against the start of a run, which has stress, too.
TEST(AStudyOfStress, HasThePeaksOfItsRuns) {
  const Workspace place;
  place.write("s.toml",
              "scenario = '" LIMBER_SOURCE_DIR
              "/examples/beam_stress.toml'\n"
              "set = ['time.duration=0.001']\n[design]\nkind = 'grid'\n"
              "[[factor]]\nname = 'force'\n"
              "path = 'load.push.force.0'\nvalues = [500, 1000]\n"
              "[[response]]\nname = 'largest'\n"
              "summary = 'stress.0.von_mises'\n"
              "[[response]]\nname = 'tip'\n"
              "probe = 'tip.max_principal'\n");
  const CommandResult study = place.limber("study s.toml --out o --csv");
  ASSERT_EQ(study.status, 0) << study.errors;
  const CommandResult run = place.limber(
      "run --from o/study.sqlite#1 --out one --json --set "
      "output.pictures=false");
  ASSERT_EQ(run.status, 0) << run.errors;
  const json summary = json::parse(run.out, nullptr, false);
  const double largest = summary["stress"][0]["von_mises"].get<double>();
  const double tip =
      summary["probes"]["tip.max_principal"]["peak"].get<double>();
  EXPECT_GT(largest, 0.0);
  EXPECT_THAT(read_text(place.folder() / "o/study.csv"),
              HasSubstr(fmt::format("1,1000,{},{},", largest, tip)));
}

TEST_F(AStudy, IsRefusedBeforeAnyRun) {
  const auto refuse = [&](const std::string& old, const std::string& by,
                          const std::string& words) {
    place_.write("study.toml", replace(kStudy, old, by));
    expect_refused("study.toml --out none", words);
    EXPECT_FALSE(fs::exists(place_.folder() / "none"));
  };
  refuse("load.push.force.0", "load.pusch.force.0", "did you mean 'push'?");
  refuse("probe = 'sled.ux'", "probe = 'sled.x'", "did you mean 'sled.ux'?");
  refuse("energy.work", "energy.wrok", "did you mean 'work'?");
  refuse("x / force", "x / forse", "did you mean 'force'?");
  refuse("x / force", "x / (force", "per_force");
  refuse("measure = 'time'", "measure = 'difference'",
         "of another 'level' from the run");
  refuse("expression = 'x / force'",
         "expression = 'x / force'\nlevel = 'rigid'",
         "a formula uses responses, which have levels");
  refuse("measure = 'time'", "level = 'rigidd'", "did you mean 'rigid'?");
  refuse("expression = 'x / force'", "contact = ['sled', 'ball']",
         "unknown contact");
  refuse("uniform = [-2.0, 2.0]\n", "",
         "factor 'force' has 0 of 'values', 'choice'");
  refuse("uniform = [-2.0, 2.0]", "values = []", "one value or more");
  refuse("uniform = [-2.0, 2.0]", "uniform = [2.0, -2.0]", "is not less than");
  refuse("log_range = [1.0, 100.0]", "log_range = [0.0, 100.0]",
         "has no logarithms");
  refuse("scenario = 's.toml'", "scenario = 's.toml'\nversion = 2", "version");
  refuse("robot.spring.coil.stiffness", "robot.spring.coyl.stiffness",
         "did you mean 'coil'?");
  place_.write("study.toml", kStudy);
  expect_refused("study.toml --shard 3/2", "expected K/N");
  expect_refused("", "needs a study file");
  place_.write("study.sqlite", "no database at all, but text of some length");
  expect_refused("study.toml --out .", "not a database");
  expect_refused("--collect study.sqlite --out c", "not a database");
  expect_refused("--collect nothing.sqlite --out c", "there is no such file");
}

}  // namespace
}  // namespace limber::test::study_test
