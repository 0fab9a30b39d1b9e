// SPDX-License-Identifier: BSD-3-Clause
// What studies tell of their responses: distributions, effects, correlations
// and figures of curves.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/sled_study.hpp"
#include "places.hpp"

namespace limber::test::study_effects_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(AStudy, TellsHowItsResponsesAreDistributed) {
  const json summary = json::parse(run("study.toml --out a --json"));
  const json& x = summary["responses"]["x"];
  EXPECT_GT(x["mean_error"], 0.0);
  EXPECT_LE(x["quantiles"]["0.05"], x["quantiles"]["0.5"]);
  EXPECT_LE(x["quantiles"]["0.5"], x["quantiles"]["0.95"]);
  if (std::system("gnuplot --version >/dev/null 2>&1") != 0) return;
  for (const char* name : {"response_x", "map_x", "matrix", "distribution"}) {
    EXPECT_TRUE(
        fs::exists(place_.folder() / "a" / (name + std::string(".png"))))
        << name;
  }
}

// Ishigami's function with a constant 100: closed forms of its effects, which
// samples of a response far from zero must not lose.
TEST_F(AStudy, TellsEffectsOfFactorsWhereItsSamplesCarryThem) {
  const auto make = [&](int samples) {
    std::string text =
        "scenario = 's.toml'\nset = ['time.duration=0.001']\n"
        "[design]\nkind = 'sobol'\nsamples = " +
        std::to_string(samples) + "\n";
    for (const char* name : {"a", "b", "c"}) {
      text += fmt::format(
          "[[factor]]\nname = '{}'\npath = 'load.push.force.{}'\nuniform = "
          "[-3.141592653589793, 3.141592653589793]\n",
          name, name[0] - 'a');
    }
    return text +
           "[[response]]\nname = 'y'\nexpression = '100 + sin(a) + "
           "7 * sin(b)^2 + 0.1 * c^4 * sin(a)'\n";
  };
  place_.write("study.toml", make(256));
  const json effects = json::parse(
      run("study.toml --out a --json"))["responses"]["y"]["effects"];
  const std::pair<const char*, double> truth[] = {
      {"a", 0.31390519}, {"b", 0.44241114}, {"c", 0.0}};
  for (const auto& [name, main] : truth) {
    const json& effect = effects[name];
    EXPECT_LE(effect["main_interval"][0], main) << name;
    EXPECT_GE(effect["main_interval"][1], main) << name;
    EXPECT_NEAR(effect["main"].get<double>(), main, 0.1) << name;
    EXPECT_FALSE(effect.contains("doubt")) << name;
  }
  place_.write("study.toml", make(12));
  EXPECT_THAT(run("study.toml --out b"),
              HasSubstr("not significant with 12 samples"));
  const json few = json::parse(run("study.toml --out b --json"));
  EXPECT_TRUE(few["responses"]["y"]["effects"]["a"]["main"].is_null());
}

// x grows with the force at any stiffness, but is no line of it.
TEST_F(AStudy, CorrelatesResponsesWithFactors) {
  const json x =
      json::parse(run("study.toml --out a --json"))["responses"]["x"];
  EXPECT_TRUE(x["correlations"].contains("force"));
  EXPECT_EQ(x["correlations"]["stiffness"]["samples"], 12);
  EXPECT_THAT(run("study.toml --out a"), HasSubstr("of ranks"));
}

// A step of a damped oscillator through the command: m = 3 kg, k = 1200 N/m,
// so omega = 20 rad/s; c = 2 zeta m omega with zeta = 0.1. Its first
// acceleration is F / m; differences around h miss less than 2 zeta omega h +
// (omega h)^2 of it.
TEST_F(AStudy, MeasuresOvershootSettlingFrequencyAndAcceleration) {
  place_.write("robot.urdf",
               replace(kRobot, "stiffness='10' free_length='1'",
                       "stiffness='1200' damping='12' free_length='1'"));
  place_.write("s.toml",
               replace(replace(kScenario, "duration = 0.5", "duration = 8.0"),
                       "output_interval = 0.01", "output_interval = 0.002"));
  std::string text =
      "scenario = 's.toml'\nset = ['initial.joints.rail.position=0.0']\n"
      "[design]\nkind = 'list'\n[[factor]]\nname = 'force'\n"
      "path = 'load.push.force.0'\nvalues = [6, -12]\n";
  for (const char* measure :
       {"overshoot", "settling_time", "frequency", "acceleration"}) {
    text += fmt::format(
        "[[response]]\nname = '{0}'\nprobe = 'sled.ux'\nmeasure = '{0}'\n",
        measure);
  }
  place_.write("study.toml", text);
  const json found = json::parse(run("study.toml --out a --json"))["responses"];
  const double zeta = 0.1;
  const double root = std::sqrt(1.0 - zeta * zeta);
  const double beyond = std::exp(-M_PI * zeta / root);
  for (const char* end : {"least", "largest"}) {
    EXPECT_NEAR(found["overshoot"][end].get<double>(), beyond, 2e-3);
    EXPECT_NEAR(found["frequency"][end].get<double>(),
                20.0 * root / (2.0 * M_PI), 0.05);
    EXPECT_LE(found["settling_time"][end].get<double>(),
              -std::log(0.02 * root) / (zeta * 20.0));
    EXPECT_GE(found["settling_time"][end].get<double>(),
              -std::log(0.02 * root) / (zeta * 20.0) - M_PI / (20.0 * root));
  }
  const double late = 2.0 * zeta * 20.0 * 0.002 + std::pow(20.0 * 0.002, 2);
  EXPECT_NEAR(found["acceleration"]["least"].get<double>(), 2.0, 2.0 * late);
  EXPECT_NEAR(found["acceleration"]["largest"].get<double>(), 4.0, 4.0 * late);
}

}  // namespace
}  // namespace limber::test::study_effects_test
