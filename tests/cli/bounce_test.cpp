// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "cli/command.hpp"

/// A ball dropped from rest, with steps of every kind: it bounces each time
/// with the restitution asked for, at the times of free fall between.
namespace limber::test::bounce_test {
namespace {

using nlohmann::json;

constexpr double kGravity = 9.81;  // [m/s^2]
constexpr double kHeight = 0.2;    // of the gap at the start [m]
constexpr double kRestitution = 0.8;

const char* const kBall =
    "<robot name='ball'><link name='ball'><inertial><mass value='0.26'/>"
    "<inertia ixx='4e-5' iyy='4e-5' izz='4e-5' ixy='0' ixz='0' iyz='0'/>"
    "</inertial><collision><geometry><sphere radius='0.02'/></geometry>"
    "</collision></link><contact link='ball' youngs_modulus='210e9' "
    "poisson_ratio='0.3'/></robot>";

std::string write_scene(const std::string& steps) {
  return fmt::format(
      "robot = 'ball.urdf'\n[time]\nduration = 1.1\n{}\n"
      "output_interval = 0.01\n"
      "[gravity]\nacceleration = [0.0, 0.0, -9.81]\n"
      "[initial.base]\nposition = [0.0, 0.0, 0.22]\n"
      "[[obstacle]]\nname = 'floor'\nshape = 'plane'\nnormal = [0, 0, 1]\n"
      "position = [0, 0, 0]\nyoungs_modulus = 210e9\npoisson_ratio = 0.3\n"
      "[[contact]]\nbetween = ['ball', 'floor']\nfriction = 0.0\n"
      "restitution = 0.8\n[output]\npictures = false\n",
      steps);
}

/// Times of touches; impacts last 0.13 ms.
std::vector<double> find_touches() {
  const double speed = std::sqrt(2.0 * kGravity * kHeight);
  std::vector<double> times = {speed / kGravity};
  for (int bounce = 1; bounce < 4; ++bounce) {
    times.push_back(times.back() +
                    2.0 * speed * std::pow(kRestitution, bounce) / kGravity);
  }
  return times;
}

json run(const Workspace& place, const std::string& steps) {
  place.write("ball.urdf", kBall);
  place.write("s.toml", write_scene(steps));
  const CommandResult result = place.limber("run s.toml --json --out o");
  EXPECT_EQ(result.status, 0) << result.errors;
  return json::parse(result.out);
}

class Bounces : public ::testing::TestWithParam<const char*> {};

TEST_P(Bounces, KeepTheirRestitutionAndTheTimesOfFreeFall) {
  const Workspace place;
  const json report = run(place, GetParam());
  const json& contacts = report["contacts"];
  ASSERT_GE(contacts.size(), 4U) << report.dump(1);
  const std::vector<double> times = find_touches();
  for (std::size_t i = 0; i < times.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_NEAR(contacts[i]["restitution"].get<double>(), kRestitution, 0.005);
    // Impacts add 0.13 ms each.
    EXPECT_NEAR(contacts[i]["time"].get<double>(), times[i],
                5e-3 + 2e-4 * static_cast<double>(i));
    const json& energy = contacts[i]["energy"];
    const double in = 0.26 * kGravity * kHeight *
                      std::pow(kRestitution, 2.0 * static_cast<double>(i));
    EXPECT_NEAR(energy["in"].get<double>() / in, 1.0, 0.02);
    EXPECT_NEAR(energy["returned"].get<double>() / in,
                kRestitution * kRestitution, 0.02);
    EXPECT_NEAR(energy["damping"].get<double>() / in,
                1.0 - kRestitution * kRestitution, 0.02);
    EXPECT_EQ(energy["friction"].get<double>(), 0.0);
    EXPECT_LT(std::abs(energy["error"].get<double>()), 0.01 * in);
  }
}

INSTANTIATE_TEST_SUITE_P(Steps, Bounces,
                         ::testing::Values("", "tolerance = 1e-3",
                                           "tolerance = 1e-4",
                                           "tolerance = 1e-6", "step = 5e-6",
                                           "step = 1e-3", "step = 7e-3"));

/// Columns of a line of a CSV file.
std::vector<std::string> split_line(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) {
    fields.push_back(field);
  }
  return fields;
}

// Outputs lie 10 ms apart, the impact lasts 0.13 ms between two of them.
TEST(BounceFiles, ShowTheForceOfAnImpactBetweenOutputs) {
  const Workspace place;
  place.write("ball.urdf", kBall);
  place.write("s.toml",
              write_scene("step = 2e-6") +
                  "[[probe]]\nname = 'grip'\ncontact = ['floor', 'ball']\n"
                  "quantity = 'force'\n");
  const CommandResult result = place.limber(
      "run s.toml --json --out o --set time.duration=0.25 "
      "--set contact.0.restitution=1.0");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json report = json::parse(result.out);
  // Hertz, two equal materials: F = k d^1.5, k = (4/3) E / (2 (1 - nu^2)) R^0.5
  const double speed = std::sqrt(2.0 * kGravity * kHeight);
  const double k = 4.0 / 3.0 * 210e9 / (2.0 * (1.0 - 0.09)) * std::sqrt(0.02);
  const double depth = std::pow(1.25 * 0.26 * speed * speed / k, 0.4);
  const double hertz = k * std::pow(depth, 1.5);
  const double peak = report["probes"]["grip.fz"]["peak"];
  EXPECT_NEAR(peak / hertz, 1.0, 0.01);

  std::istringstream peaks(read_text(place.folder() / "o/peaks.csv"));
  bool has_row = false;
  for (std::string line; std::getline(peaks, line);) {
    const auto fields = split_line(line);
    if (fields.at(0) != "grip.fz") continue;
    has_row = true;
    EXPECT_EQ(fields.at(1), "N");
    EXPECT_EQ(std::stod(fields.at(2)), peak);
    EXPECT_EQ(std::stod(fields.at(3)),
              report["probes"]["grip.fz"]["peak_time"].get<double>());
  }
  EXPECT_TRUE(has_row);

  std::istringstream envelopes(read_text(place.folder() / "o/envelopes.csv"));
  std::string line;
  std::getline(envelopes, line);
  const auto names = split_line(line);
  const auto column = static_cast<std::size_t>(
      std::find(names.begin(), names.end(), "grip.fz most [N]") -
      names.begin());
  ASSERT_LT(column, names.size());
  double largest = 0.0;
  int touched = 0;
  int rows = 0;
  for (; std::getline(envelopes, line); ++rows) {
    const double most = std::stod(split_line(line).at(column));
    largest = std::max(largest, most);
    if (most > 0.0) ++touched;
  }
  EXPECT_EQ(rows, 25);
  EXPECT_EQ(largest, peak);
  EXPECT_EQ(touched, 1);
}

/// The speeds of three balls of 30 g of which one strikes two at 1 m/s that are
/// `gap` apart.
std::vector<double> strike_cradle(double gap) {
  const Workspace place;
  place.write("ball.urdf", kBall);
  std::string scene =
      "robot = 'ball.urdf'\n[time]\nduration = 1.5e-3\nstep = 5e-7\n"
      "output_interval = 1.5e-4\n[output]\npictures = false\n"
      "[initial.base]\nposition = [0.0, 0.0, 100.0]\n"
      "[[contact]]\nbetween = ['b?', 'b?']\nfriction = 0.0\n"
      "restitution = 0.9\n";
  const std::vector<double> x = {-1e-5, 0.02, 0.04 + gap};
  for (std::size_t i = 0; i < 3; ++i) {
    scene += fmt::format(
        "[[projectile]]\nname = 'b{0}'\nradius = 0.01\nmass = 0.03\n"
        "position = [{1:.17g}, 0.0, 0.0]\nvelocity = [{2}, 0.0, 0.0]\n"
        "youngs_modulus = 2e9\npoisson_ratio = 0.3\n"
        "[[probe]]\nname = 'v{0}'\nlink = 'b{0}'\nquantity = 'velocity'\n",
        i, x[i], i == 0 ? 1.0 : 0.0);
  }
  place.write("s.toml", scene);
  const CommandResult result = place.limber("run s.toml --out o");
  EXPECT_EQ(result.status, 0) << result.errors;
  std::istringstream lines(read_text(place.folder() / "o/probes.csv"));
  std::string head;
  std::getline(lines, head);
  std::string last;
  for (std::string line; std::getline(lines, line);) last = line;
  std::istringstream columns(last);
  std::istringstream names(head);
  std::vector<double> speeds;
  std::string value;
  for (std::string name;
       std::getline(names, name, ',') && std::getline(columns, value, ',');) {
    if (name.find(".vx") != std::string::npos) {
      speeds.push_back(std::stod(value));
    }
  }
  return speeds;
}

// By a Runge-Kutta solution of the springs; a gap of 0 is the limit of small
// ones.
TEST(Cradle, OfThreeBallsDoesNotDependOnHowATouchBegan) {
  for (const double gap : {1e-8, 0.0}) {
    const std::vector<double> speeds = strike_cradle(gap);
    ASSERT_EQ(speeds.size(), 3U);
    EXPECT_NEAR(speeds[0], -0.0374, 1e-3) << gap;
    EXPECT_NEAR(speeds[1], 0.1316, 1e-3) << gap;
    EXPECT_NEAR(speeds[2], 0.9058, 1e-3) << gap;
    EXPECT_NEAR(speeds[0] + speeds[1] + speeds[2], 1.0, 1e-9) << gap;
  }
}

TEST(StepsWithoutAChoice, TakeATenThousandthOfTheLargestBodysSize) {
  const Workspace place;
  place.write("ball.urdf", kBall);
  place.write("s.toml", write_scene(""));
  const CommandResult text = place.limber("run s.toml --out o");
  // Twice the radius of gyration, 2 sqrt(1.5 4e-5 / 0.26) = 0.0304 m.
  EXPECT_THAT(text.out, ::testing::HasSubstr(
                            "tolerance 3.04e-06 m, 1e-4 of the smallest "
                            "group's largest body, as no step is given"));
  const json report = run(place, "");
  EXPECT_NEAR(report["tolerance"].get<double>(), 3.04e-6, 1e-8);
  EXPECT_EQ(report["passes"], 1);
  EXPECT_EQ(report["tolerance_passes"], "one");
  EXPECT_FALSE(report.contains("estimated_error"));
  const json verified =
      run(place, "tolerance = 1e-4\ntolerance_passes = 'verified'");
  EXPECT_GE(verified["passes"].get<int>(), 2);
  EXPECT_LE(verified["estimated_error"].get<double>(), 1e-4);
}

// Also to the tolerance of a scene that names none.
TEST(StepsWithoutAChoice, AreVerifiedUnderASinusoidalLoad) {
  const Workspace place;
  place.write("ball.urdf", kBall);
  const std::string load =
      "[[load]]\nname = 'push'\nlink = 'ball'\nforce = [1e-3, 0, 0]\n"
      "frame = 'world'\ntime = { kind = 'sinusoid', frequency = 5 }\n";
  const auto run_with = [&](const std::string& options) {
    place.write("s.toml", write_scene("") + load);
    const CommandResult result =
        place.limber("run s.toml --json --out o " + options);
    EXPECT_EQ(result.status, 0) << result.errors;
    return json::parse(result.out);
  };
  const json verified = run_with("");
  EXPECT_EQ(verified["tolerance_passes"], "verified");
  EXPECT_GE(verified["passes"].get<int>(), 2);
  EXPECT_LE(verified["estimated_error"].get<double>(),
            verified["tolerance"].get<double>());
  const json one = run_with("--set time.tolerance_passes=one");
  EXPECT_EQ(one["tolerance_passes"], "one");
  EXPECT_EQ(one["passes"], 1);
}

TEST(StepsWithoutAChoice, AreAnErrorForOtherIntegratorsAndOtherWords) {
  const Workspace place;
  place.write("ball.urdf", kBall);
  place.write("s.toml", write_scene("integrator = 'runge-kutta-4'"));
  const CommandResult explicit_one = place.limber("run s.toml --out o");
  EXPECT_EQ(explicit_one.status, 2);
  EXPECT_THAT(explicit_one.errors, ::testing::HasSubstr("'step'"));
  place.write("s.toml", write_scene("tolerance_passes = 'two'"));
  const CommandResult word = place.limber("run s.toml --out o");
  EXPECT_EQ(word.status, 2);
  EXPECT_THAT(word.errors, ::testing::HasSubstr("tolerance_passes"));
}

}  // namespace
}  // namespace limber::test::bounce_test
