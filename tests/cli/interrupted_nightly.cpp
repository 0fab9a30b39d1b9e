// SPDX-License-Identifier: BSD-3-Clause
// Runs that a signal ends at any step and that go on have the results of whole
// ones: every byte of results.h5, and the summary except for what it cost.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "cli/run_summary.hpp"
#include "cli/shell.hpp"
#include "places.hpp"

namespace limber::test::interrupted_nightly {
namespace {

namespace fs = std::filesystem;
using std::chrono::duration;
using std::chrono::steady_clock;

// A robot with a joint, tendon, gear, latch, drive, stop and friction of every
// kind, and a mesh of 24 mm bars (tests/data/zoo).
const std::string kZoo =
    "run '" LIMBER_SOURCE_DIR "/tests/data/zoo/s.toml' --out ";

struct Whole {
  duration<double> time = {};
  nlohmann::json summary;
  std::string results;
};

Whole run_whole(const Workspace& place, const std::string& command,
                const std::string& options) {
  Whole whole;
  for (int i = 0; i < 2; ++i) {  // the first reduces, too
    const auto begin = steady_clock::now();
    const CommandResult result = place.limber(command + "whole" + options);
    EXPECT_EQ(result.status, 0) << result.errors;
    whole.time = steady_clock::now() - begin;
  }
  whole.summary = read_summary(place.folder() / "whole");
  whole.results = read_text(place.folder() / "whole/results.h5");
  return whole;
}

// Whether the signal came before the end.
bool interrupt(const Workspace& place, const std::string& arguments, int signal,
               duration<double> moment) {
  RunningCommand run(place, arguments);
  std::this_thread::sleep_for(moment);
  run.send(signal);
  return run.wait().status == 128 + signal;
}

void expect_same_answer(const std::string& command, const std::string& options,
                        int moments) {
  const Workspace place;
  const Whole whole = run_whole(place, command, options);
  std::mt19937 random(46);
  std::uniform_real_distribution<double> share(0.3, 0.95);
  int interrupted = 0;
  for (int i = 0; i < moments; ++i) {
    const std::string out = fmt::format("o{}", i);
    const int signal = i % 2 == 0 ? SIGTERM : SIGINT;
    // The second one ends a run that goes on.
    for (const char* more : {"", " --resume"}) {
      const bool was = interrupt(place, command + out + options + more, signal,
                                 share(random) * whole.time);
      interrupted += was ? 1 : 0;
    }
    const CommandResult rest =
        place.limber(command + out + options + " --resume");
    EXPECT_EQ(rest.status, 0) << rest.errors;
    const fs::path folder = place.folder() / out;
    EXPECT_EQ(read_summary(folder), whole.summary) << options;
    EXPECT_TRUE(read_text(folder / "results.h5") == whole.results) << options;
    EXPECT_FALSE(fs::exists(folder / "checkpoint.bin"));
  }
  EXPECT_GE(2 * interrupted, moments);  // else signals came after the end
}

TEST(InterruptedRun, OfAnUnreducedBodyGivesTheAnswerOfAWholeOne) {
  expect_same_answer(kZoo, " --set time.duration=0.04", 4);
}

// The unit tests of checkpoints have the explicit schemes of low order, too.
TEST(InterruptedRun, OfEverySchemeGivesTheAnswerOfAWholeOne) {
  const std::vector<std::pair<const char*, double>> schemes = {
      {"generalized-alpha", 0.1},
      {"implicit-euler", 0.1},
      {"energy-conserving", 0.03},  // [s]
      {"runge-kutta-4", 0.004},
      {"splitting", 0.002}};
  for (const auto& [scheme, duration] : schemes) {
    expect_same_answer(
        kZoo,
        fmt::format(" --set fidelity.default=coupled --set time.step=1e-5 "
                    "--set time.integrator={} --set time.duration={}",
                    scheme, duration),
        2);
  }
}

TEST(InterruptedRun, ToAToleranceGivesTheAnswerOfAWholeOne) {
  for (const char* passes : {"one", "verified"}) {
    expect_same_answer(
        kZoo,
        fmt::format(" --set fidelity.default=coupled --unset time.step --set "
                    "time.tolerance=1e-6 --set time.duration=0.05 --set "
                    "time.tolerance_passes={}",
                    passes),
        3);
  }
}

const std::string kExample =
    "run '" LIMBER_SOURCE_DIR "/examples/{}.toml' --out ";

TEST(InterruptedRun, WithContactGivesTheAnswerOfAWholeOne) {
  for (const char* example : {"catch", "self_strike", "struck_finger"}) {
    expect_same_answer(fmt::format(fmt::runtime(kExample), example),
                       " --set output.pictures=false", 3);
  }
}

// A summary says where the contact was strongest, which may be long ago.
TEST(InterruptedRun, OfAnExplicitSchemeWithContactGivesTheAnswerOfAWholeOne) {
  expect_same_answer(fmt::format(fmt::runtime(kExample), "ball_on_link"),
                     " --set output.pictures=false --set "
                     "time.integrator=central-differences",
                     4);
}

}  // namespace
}  // namespace limber::test::interrupted_nightly
